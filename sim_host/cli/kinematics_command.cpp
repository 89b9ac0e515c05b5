#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim_host/cli/command.hpp"
#include "sim_host/kinematics/joint_limits.hpp"
#include "sim_host/kinematics/kinematics_file.hpp"
#include "sim_host/kinematics/path_csv.hpp"
#include "sim_host/kinematics/pose_report.hpp"
#include "sim_host/kinematics/trajectory_csv.hpp"
#include "sim_host/kinematics/trajectory_page.hpp"
#include "sim_host/support/distinct_files.hpp"
#include "sim_host/support/output_file.hpp"

namespace morepro::host {
namespace {

constexpr const char* kKinematicsWords =
    R"(path.csv, the points of straight segments; each takes duration_s from the point before it:
  x_m,y_m,z_m,roll_deg,duration_s
  0.3,0.1,0.4,0,
  0.5,0.15,0.5,30,2
  0.45,0.3,0.55,-15,1.5

path.toml, or a --chain file (every table is optional; an own chain follows the Denavit-Hartenberg convention):
  [placement]                 # takes the points to the machine's base
  x_m = 0.3
  yaw_deg = 30
  [inverse]
  method = "clik"             # or "closed_form", for the built-in machine
  gain_per_s = 50
  [limits]                    # a segment whose time needs more is refused
  max_speed_m_s = 0.5
  max_acceleration_m_s2 = 5
  [[joint]]
  kind = "revolute"           # or "prismatic"
  a_m = 0.5
  alpha_deg = 0
  lowest_deg = -120
  highest_deg = 120
  [[point]]
  x_m = 0.4
  [[point]]
  x_m = 0.2
  duration_s = 1.0)";

constexpr const char* kKinematicsExamples =
    R"(  printf '%s\n' x_m,y_m,z_m,roll_deg,duration_s 0.3,0.1,0.4,0, 0.5,0.15,0.5,30,2 > path.csv
  morepro kinematics path.csv --out joints.csv
  morepro kinematics path.csv --report page.html      # the machine moving along the path, in a browser
  morepro kinematics path.csv --method clik --gain 50 --rate 1000 --out joints.csv
  morepro kinematics --forward 0.1 0.2 0.3 1.57
  morepro kinematics --inverse 0.57 0.3 0.5 1.57 --json -)";

struct KinematicsArguments {
  std::string path;
  std::string chain;
  std::string out;
  std::string report;
  std::string json;
  std::string method;
  double gain_per_s = 0.0;
  double rate_hz = 0.0;
  std::vector<double> forward;
  std::vector<double> inverse;
  CLI::Option* gain_option = nullptr;
  CLI::Option* rate_option = nullptr;
};

bool is_toml(const std::string& path) { return path.ends_with(".toml"); }

/// A path of the user's own chain, in two files.
void take_points(const KinematicsArguments& arguments, KinematicsJob& job) {
  if (is_toml(arguments.path)) {
    KinematicsJob points = read_kinematics_file(arguments.path);
    if (!arguments.chain.empty() && !points.chain.is_built_in)
      throw UserError(fmt::format("{} holds a chain, and so does --chain; give one", arguments.path));
    if (!arguments.chain.empty()) {
      const ToolLimits limits = stricter_of(points.chain.limits, job.chain.limits);
      points.chain = job.chain;
      points.chain.limits = limits;
    }
    job = std::move(points);
  } else if (arguments.path.ends_with(".csv")) {
    job.points.clear();
    read_path_csv(arguments.path, job);
  } else {
    throw UsageError(fmt::format("'{}' is no path file; its name must end in .csv or .toml", arguments.path));
  }
}

KinematicsJob job_of(const KinematicsArguments& arguments) {
  KinematicsJob job;
  if (!arguments.chain.empty()) job = read_kinematics_file(arguments.chain);
  if (!arguments.path.empty()) take_points(arguments, job);
  if (!arguments.method.empty()) job.inverse.method = inverse_method_of(arguments.method);
  if (arguments.gain_option->count() > 0) {
    if (method_of(job) != InverseMethod::kClik)
      throw UsageError("--gain is of CLIK, the closed form has none; add --method clik");
    job.inverse.gain_per_s = arguments.gain_per_s;
  }
  if (arguments.rate_option->count() > 0) job.inverse.rate_hz = arguments.rate_hz;
  return job;
}

std::string summary_text(const KinematicsJob& job, const TrajectorySummary& summary) {
  std::string text =
      fmt::format("{} segment{} in {:g} s, {} rows at {:g} Hz", summary.segments,
                  summary.segments == 1 ? "" : "s", summary.duration_s, summary.rows, job.inverse.rate_hz);
  if (method_of(job) == InverseMethod::kClosedForm) return text + "; joints in closed form";
  text += fmt::format("; joints by CLIK, gain {:g}/s, largest error {:.3g} (m, rad)", job.inverse.gain_per_s,
                      summary.largest_error);
  return text + (summary.passed_singularity ? ", damped beside a singularity" : "");
}

void write_trajectory(const KinematicsArguments& arguments) {
  if (arguments.out.empty() && arguments.report.empty()) {
    throw UsageError(
        "--out or --report is missing; name the file for the joints (--out, '-': standard output) or for the "
        "page that shows them (--report)");
  }
  if (!arguments.json.empty())
    throw UsageError("--json belongs to --forward and --inverse; a path is written by --out");
  const KinematicsJob job = job_of(arguments);
  std::optional<TrajectoryPage> page;
  if (!arguments.report.empty()) page.emplace(job);
  const auto out = open_if_asked(arguments.out);
  const auto report = open_if_asked(arguments.report);
  std::optional<TrajectoryCsv> csv;
  const TrajectorySummary summary = compute_trajectory(job, [&](const TrajectoryRow& row) {
    if (out && !csv) csv.emplace(*out, job);
    if (csv) csv->write(row);
    if (page) page->add(row);
  });
  const std::string text = summary_text(job, summary);
  if (report) report->write(page->html(text));
  if (out) out->commit();
  if (report) report->commit();
  if (arguments.out != "-" && arguments.report != "-") fmt::print("{}\n", text);
}

kinematics::JointVector<double> forward_joints(const KinematicsArguments& arguments,
                                               const ChainDescription& chain) {
  if (arguments.forward.size() != chain.table.count) {
    throw UsageError(fmt::format("--forward has {} values, the chain has {} joints ({})",
                                 arguments.forward.size(), chain.table.count,
                                 fmt::join(joint_names(chain.table), ", ")));
  }
  kinematics::JointVector<double> joints{};
  std::copy(arguments.forward.begin(), arguments.forward.end(), joints.begin());
  if (const std::string outside = outside_limits(chain.table, joints, 0.0); !outside.empty())
    throw UserError(fmt::format("the joints cannot be there: {}", outside));
  return joints;
}

kinematics::JointVector<double> inverse_joints(const std::vector<double>& values,
                                               const ChainDescription& chain) {
  if (values.size() != 3 && values.size() != 4 && values.size() != 6) {
    throw UsageError(
        fmt::format("--inverse has {} values; give x y z in m, then nothing, roll, or roll pitch yaw in rad",
                    values.size()));
  }
  kinematics::Waypoint<double> pose;
  for (std::size_t i = 0; i < values.size(); ++i)
    (i < 3 ? pose.position_m : pose.angles_rad)(static_cast<int>(i % 3)) = values[i];
  const auto rows = static_cast<kinematics::TaskRows>((1 << values.size()) - 1);
  return joints_for(chain, rows, pose);
}

void check_finite(const std::vector<double>& values) {
  for (const double value : values) {
    if (!std::isfinite(value)) throw UsageError("a value is not finite; give finite numbers");
  }
}

void write_pose(const KinematicsArguments& arguments) {
  check_finite(arguments.forward);
  check_finite(arguments.inverse);
  const ChainDescription chain = job_of(arguments).chain;
  const auto joints =
      arguments.forward.empty() ? inverse_joints(arguments.inverse, chain) : forward_joints(arguments, chain);
  const PoseReport report = report_of(chain, joints);
  if (arguments.json != "-") fmt::print("{}", pose_text(chain, report));
  if (arguments.json.empty()) return;
  OutputFile file(arguments.json);
  file.write(pose_json(chain, report));
  file.commit();
}

void run(const KinematicsArguments& arguments) {
  const int jobs = (arguments.path.empty() ? 0 : 1) + (arguments.forward.empty() ? 0 : 1) +
                   (arguments.inverse.empty() ? 0 : 1);
  if (jobs != 1)
    throw UsageError("give one of a path file, --forward and --inverse; see morepro kinematics --help");
  check_distinct({{"the path", arguments.path}, {"--chain", arguments.chain}},
                 {{"--out", arguments.out}, {"--json", arguments.json}, {"--report", arguments.report}});
  if (!arguments.path.empty()) return write_trajectory(arguments);
  if (!arguments.out.empty()) throw UsageError("--out belongs to a path; a single pose is written by --json");
  if (!arguments.report.empty())
    throw UsageError("--report belongs to a path; a single pose is written by --json");
  write_pose(arguments);
}

}  // namespace

void add_kinematics(CLI::App& program) {
  auto arguments = std::make_shared<KinematicsArguments>();
  CLI::App* command = program.add_subcommand(
      "kinematics",
      "joints along a path; the tool's pose from joints and back, for any chain of up to 8 joints");
  command->add_option("path", arguments->path, "points of the path, .csv or .toml");
  command->add_option("--out", arguments->out, "joint trajectory to write, CSV; '-': standard output");
  command->add_option("--report", arguments->report,
                      "page that shows the machine moving along the path (HTML, one file, no network)");
  command->add_option("--chain", arguments->chain, "own chain, .toml; by default the thesis's machine");
  command
      ->add_option("--method", arguments->method,
                   "how joints are found: closed_form (built-in machine) or clik (any chain)")
      ->check(one_of({"closed_form", "clik"}));
  arguments->gain_option = command->add_option("--gain", arguments->gain_per_s,
                                               "CLIK gain K in 1/s, above 0 and below 2 x rate (50)");
  arguments->rate_option = command->add_option("--rate", arguments->rate_hz, "rows per second (1000)");
  command->add_option("--forward", arguments->forward, "joint values (m, rad): print the tool's pose")
      ->delimiter(',');
  command
      ->add_option("--inverse", arguments->inverse,
                   "x y z in m, optionally roll or roll pitch yaw in rad: print the joints")
      ->delimiter(',');
  command->add_option("--json", arguments->json, "write a single pose as JSON; '-': standard output");
  add_examples(*command, kKinematicsWords, kKinematicsExamples);
  command->callback([arguments] { run(*arguments); });
}

}  // namespace morepro::host
