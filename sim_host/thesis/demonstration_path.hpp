#pragma once
#include "sim_host/kinematics/kinematics_job.hpp"

namespace morepro::host::thesis {

/// Four points in a plane and a transform that takes them into space, as in the thesis's section 3.4, which
/// gives no coordinates, times, gain or step: these are ours. CLIK, from a start that is off.
KinematicsJob demonstration_path();

}  // namespace morepro::host::thesis
