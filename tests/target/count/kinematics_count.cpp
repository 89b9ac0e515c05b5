#include "lib/kinematics/clik.hpp"
#include "lib/kinematics/morepro_machine.hpp"
#include "lib/kinematics/path.hpp"
#include "tests/target/count/count.hpp"

namespace morepro::count {
namespace {

using namespace kinematics;

JointVector<float> joints{0.1F, 0.2F, 0.3F, 0.0F};
float time_s = 0.0F;

void move_on() {
  joints[3] += 0.01F;
  time_s = time_s < 1.9F ? time_s + 0.001F : 0.0F;
}

void place_tool() {
  static const Chain<float> chain(morepro_table());
  const ChainFrames<float> frames = chain.frames(joints);
  keep(frames);
  keep(chain.jacobian(frames));
}

void invert_pose() {
  const RollPose<float> pose{{0.5F, 0.1F, 0.4F}, joints[3]};
  keep(pose);
  keep(inverse_of(MachineGeometry{}, pose));
}

const Path<float, 2>& path() {
  static const Path<float, 2> straight = [] {
    Path<float, 2> built;
    (void)built.add({{0.3F, 0.1F, 0.4F}, {0.0F, 0.0F, 0.0F}}, 0.0F);
    (void)built.add({{0.5F, 0.2F, 0.3F}, {0.6F, 0.0F, 0.0F}}, 2.0F);
    return built;
  }();
  return straight;
}

void follow_path() { keep(path().at(time_s)); }

void invert_by_clik() {
  static Clik<float> clik(Chain<float>(morepro_table()), ClikSettings{}, {-0.1F, 0.0F, 0.03F, 0.0F});
  static const ToolState<float> wanted = path().at(0.5F);
  keep(clik.step(wanted));
}

const Entry kPose{"kinematics_pose", 1, move_on, place_tool};
const Entry kClosedForm{"inverse_closed_form", 1, move_on, invert_pose};
const Entry kPath{"path_point", 1, move_on, follow_path};
const Entry kClik{"clik_step", 1, move_on, invert_by_clik};

}  // namespace
}  // namespace morepro::count
