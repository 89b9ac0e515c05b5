#pragma once
#include <functional>
#include <memory>

#include "sim_host/diagnose/fit/innovation_pass.hpp"
#include "sim_host/machine/machine_description.hpp"

namespace morepro::host {

/// The machine's model beside a recording that is not kept in memory: frame by frame, both axes. It is told
/// the commanded chip load, so that what a blunt tool needs beyond that is left over.
class LiveModel {
 public:
  explicit LiveModel(const MachineDescription& machine);
  ~LiveModel();

  using OnSample = std::function<void(Axis axis, const Innovation& innovation, double measured)>;
  /// The frame of a row of the recording's grid; `row` increases. Rows between are missing.
  void take(std::uint64_t row, const SensorFrame& frame, const OnSample& on_sample);

 private:
  struct Observers;
  std::unique_ptr<Observers> observers_;
};

}  // namespace morepro::host
