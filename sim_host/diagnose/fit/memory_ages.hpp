#pragma once
#include <Eigen/Core>
#include <array>

namespace morepro::host {

/// Past innovations of these ages, in rows, share one weight: the older, the more of them.
struct Ages {
  Eigen::Index first;
  Eigen::Index last;
};

inline constexpr std::array<Ages, 9> kShortMemory{
    {{1, 1}, {2, 2}, {3, 3}, {4, 4}, {5, 6}, {7, 8}, {9, 12}, {13, 16}, {17, 24}}};
inline constexpr std::array<Ages, 13> kLongMemory{{{1, 1},
                                                   {2, 2},
                                                   {3, 3},
                                                   {4, 4},
                                                   {5, 5},
                                                   {6, 6},
                                                   {7, 8},
                                                   {9, 11},
                                                   {12, 16},
                                                   {17, 24},
                                                   {25, 40},
                                                   {41, 72},
                                                   {73, 128}}};

}  // namespace morepro::host
