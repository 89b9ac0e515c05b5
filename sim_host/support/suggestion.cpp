#include "sim_host/support/suggestion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <numeric>
#include <vector>

namespace morepro::host {

namespace {

/// Of `a` from the first j letters of `b`, for every j.
std::vector<std::size_t> distances(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row;
}

/// Of a word from a candidate, or from its beginning: somebody left its end off.
std::size_t slips(std::string_view word, std::string_view candidate) {
  const std::vector<std::size_t> row = distances(word, candidate);
  constexpr std::size_t kShortest = 4;
  return word.size() < kShortest ? row.back() : std::min(row.back(), *std::ranges::min_element(row) + 1);
}

/// Capitals are no slip of the keyboard.
std::string in_lower_case(std::string_view word) {
  std::string lower(word);
  std::ranges::transform(lower, lower.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) { return distances(a, b).back(); }

std::string_view nearest(std::string_view word, std::span<const std::string_view> candidates) {
  const std::string typed = in_lower_case(word);
  // A third of the letters: a slip of the keyboard or a forgotten unit, not another word.
  std::size_t best_distance = std::max(word.size() / 3, std::size_t{1}) + 1;
  std::string_view best;
  for (const std::string_view candidate : candidates) {
    const std::size_t distance = slips(typed, in_lower_case(candidate));
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

std::string did_you_mean(std::string_view word, std::span<const std::string_view> candidates) {
  const std::string_view best = nearest(word, candidates);
  return best.empty() ? std::string{} : fmt::format(" (did you mean '{}'?)", best);
}

}  // namespace morepro::host
