#include "tools/mdof/linuxcnc/live_compensation.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "schema/base/number/number.h"
#include "schema/base/number/number_text.h"
#include "schema/base/trimmed.h"
#include "schema/units.h"

namespace mdof::tools {
namespace {

constexpr double kSecondPerNs = 1e-9;
// The offset causes a following error, because the drive lags by up to 10 servo periods. This error
// may be at most a tenth of MIN_FERROR.
constexpr double kLaggingPeriods = 10, kShareOfFollowingError = 0.1;
constexpr double kShareOfAxis = 0.05;  // share of MAX_VELOCITY and MAX_ACCELERATION for the offset
constexpr double kMostVelocity_mm_s = 1, kMostAcceleration_mm_s2 = 50, kFade_mm_s = 0.04;

class LiveLimits {
 public:
  LiveLimits(const LinuxCncIni& ini, const HalWiring& wiring, const LiveRequest& request)
      : ini_(ini), wiring_(wiring), request_(request) {}

  Result<LiveCompensation> live() {
    read_units();
    read_joints();
    read_period();
    if (refused_.empty()) set_limits();
    if (refused_.empty()) write_hal();
    if (refused_.empty()) return live_;
    std::string all;
    for (const std::string& what : refused_) all += (all.empty() ? "" : "; ") + what;
    return bad_input(ini_.file.string() + ": " + all);
  }

 private:
  void refuse(const std::string& what) { refused_.push_back(what); }

  std::optional<double> number(const std::string& section, const std::string& key) {
    const IniEntry* entry = ini_.find(section, key);
    if (!entry) return {};
    double x = 0;
    const char* end = entry->value.data() + entry->value.size();
    if (parse_double(entry->value.data(), end, x) == end && std::isfinite(x)) return x;
    refuse("line " + std::to_string(entry->line) + ": [" + section + "]" + key + " = " +
           entry->value + " is not a number");
    return {};
  }

  double needed(const std::string& section, const std::string& key, bool positive = true) {
    const std::size_t refused = refused_.size();
    const auto x = number(section, key);
    if (!x && refused == refused_.size())
      refuse("[" + section + "]" + key + " is missing");
    else if (x && positive && !(*x > 0))
      refuse("[" + section + "]" + key + " = " + plain_number(*x) + " must be above 0");
    return x.value_or(1);
  }

  void read_units() {
    const auto inch = is_inch_machine(ini_);
    if (!inch) return refuse(inch.error().message);
    live_.inch = *inch;
    unit_ = live_.inch ? 1 / to_mm(kInch_m) : 1;
  }

  // Reads the joints of each axis.
  void read_joints() {
    const auto all = trivkins_joints(ini_);
    if (!all) return refuse(all.error().message);
    const double count = needed("KINS", "JOINTS");
    for (const char axis : std::string_view("XYZ")) {
      std::vector<LiveJoint> joints;
      for (const AxisJoint& joint : *all)
        if (joint.axis == axis && joint.number < count)
          joints.push_back({axis, joint.number, !joints.empty()});
      if (joints.size() > 2)
        refuse(
            std::string("[KINS]KINEMATICS: axis ") + axis + " has " +
            std::to_string(joints.size()) +
            " joints, but live compensation is possible only if each axis has one or two joints");
      for (const LiveJoint& joint : joints) check_joint(section_of(joint));
      if (joints.size() == 2) check_pair(section_of(joints[0]), section_of(joints[1]), axis);
      live_.joints.insert(live_.joints.end(), joints.begin(), joints.end());
    }
    if (live_.joints.empty()) refuse("[KINS]KINEMATICS: the machine has no axis X, Y or Z");
  }

  // Checks that the two joints of an axis have the same settings, because they get the same offset
  // in machine units. The sign of SCALE may differ: SCALE acts after the component, and is negative
  // for a motor that is mounted in the opposite direction.
  void check_pair(const std::string& first, const std::string& second, char axis) {
    const auto differ = [&](const char* key, double of_first, double of_second) {
      if (of_first == of_second) return;
      refuse("[" + second + "]" + key + " = " + plain_number(of_second) + " and [" + first + "]" +
             key + " = " + plain_number(of_first) +
             ": the two values must be equal, because both joints of axis " + axis +
             " get the same offset");
    };
    for (const char* key : {"HOME", "MIN_LIMIT", "MAX_LIMIT", "MAX_VELOCITY", "MAX_ACCELERATION"})
      differ(key, number(first, key).value_or(0), number(second, key).value_or(0));
    for (const char* key : {"SCALE", "STEP_SCALE", "OUTPUT_SCALE", "INPUT_SCALE", "ENCODER_SCALE"})
      differ(key, std::abs(first_number(first, key)), std::abs(first_number(second, key)));
  }

  // The first number of a value such as "SCALE = 1000 0"; the second number is an offset.
  double first_number(const std::string& section, const std::string& key) {
    const std::string text = ini_.value(section, key);
    const auto words = words_of(text);
    double x = 0;
    if (!words.empty()) parse_double(words[0].data(), words[0].data() + words[0].size(), x);
    return x;
  }

  static std::string section_of(const LiveJoint& joint) {
    return "JOINT_" + std::to_string(joint.joint);
  }

  void check_joint(const std::string& section) {
    const std::string type = ini_.value(section, "TYPE");
    if (type != "LINEAR") refuse("[" + section + "]TYPE = \"" + type + "\" must be LINEAR");
    if (ini_.find(section, "COMP_FILE"))
      refuse(
          "[" + section +
          "]COMP_FILE: LinuxCNC would apply both this file and the live table; remove COMP_FILE");
    if (number(section, "BACKLASH").value_or(0) != 0)
      refuse("[" + section +
             "]BACKLASH: the errors in the table must be measured without BACKLASH; remove "
             "BACKLASH and measure again");
    const double least = needed(section, "MIN_LIMIT", false);
    if (needed(section, "MAX_LIMIT", false) <= least)
      refuse("[" + section + "]MAX_LIMIT is not above MIN_LIMIT");
    for (const char* key : {"MAX_VELOCITY", "MAX_ACCELERATION", "MIN_FERROR", "FERROR"})
      needed(section, key);
  }

  void read_period() { period_s_ = needed("EMCMOT", "SERVO_PERIOD") * kSecondPerNs; }

  void at_most(double& limit, double most, std::string& reason, const std::string& why) {
    if (most >= limit) return;
    limit = most;
    reason = why;
  }

  void set_limits() {
    std::string unused;
    live_.max_offset = request_.margin_mm * unit_;
    live_.offset_reason = "--margin-mm";
    live_.max_velocity = kMostVelocity_mm_s * unit_;
    live_.velocity_reason = "fixed limit of mdof";
    live_.max_acceleration = kMostAcceleration_mm_s2 * unit_;
    for (const LiveJoint& joint : live_.joints) {
      const std::string s = section_of(joint);
      const auto home = number(s, "HOME_OFFSET");
      const double beyond = home ? std::max(needed(s, "MIN_LIMIT", false) - *home,
                                            *home - needed(s, "MAX_LIMIT", false))
                                 : 0;
      if (beyond > 0)
        at_most(live_.max_offset, beyond, live_.offset_reason,
                "distance of [" + s + "]HOME_OFFSET beyond the soft limit");
      at_most(live_.max_velocity,
              kShareOfFollowingError * needed(s, "MIN_FERROR") / (kLaggingPeriods * period_s_),
              live_.velocity_reason, "[" + s + "]MIN_FERROR");
      at_most(live_.max_velocity, kShareOfAxis * needed(s, "MAX_VELOCITY"), live_.velocity_reason,
              "[" + s + "]MAX_VELOCITY");
      at_most(live_.max_acceleration, kShareOfAxis * needed(s, "MAX_ACCELERATION"), unused, "");
    }
    live_.fade_velocity = std::min(kFade_mm_s * unit_, live_.max_velocity);
    for (const LiveJoint& joint : live_.joints) check_headroom(section_of(joint));
  }

  // Checks that the step generator may be faster than the joint. Otherwise the offset would cause a
  // following error while cutting.
  void check_headroom(const std::string& section) {
    for (const auto& [drive, axis, more] :
         {std::tuple{"STEPGEN_MAXVEL", "MAX_VELOCITY", live_.max_velocity},
          {"STEPGEN_MAXACCEL", "MAX_ACCELERATION", live_.max_acceleration}}) {
      const double most = number(section, drive).value_or(0), least = needed(section, axis) + more;
      if (most != 0 && most < least)
        refuse("[" + section + "]" + drive + " = " + plain_number(most) + " must be at least " +
               plain_number(least) + " (" + axis + " plus the limit for the correction)");
    }
  }

  // Connects two pins. A pin can be connected to only one signal: if the user's files already
  // connect `pin` to a signal, this signal is used.
  void net(const std::string& name, const std::string& pin, const std::string& to) {
    const std::string signal = wiring_.signal(pin, name);
    live_.hal +=
        "net " + signal + (signal == name ? " " + pin : "") + " => mdof-compensation." + to + "\n";
  }

  std::optional<int> place_of(const std::string& function, std::string& thread) {
    for (const HalFunction& f : wiring_.functions)
      if (f.name == function) thread = f.thread;
    int place = 0;
    for (const HalFunction& f : wiring_.functions) {
      if (f.thread != thread) continue;
      ++place;
      if (f.name == function) return place;
    }
    return {};
  }

  void write_hal() {
    std::string not_read, thread, other;
    for (const std::string& file : wiring_.not_read) not_read += " " + file;
    const std::string unseen =
        not_read.empty() ? "" : " (mdof did not read these files:" + not_read + ")";
    const auto reads = place_of("motion-command-handler", thread);
    const auto moves = place_of("motion-controller", other);
    if (!reads || !moves || thread != other || *moves < *reads)
      return refuse(
          "[HAL]HALFILE: the HAL files do not add (addf) motion-command-handler and "
          "motion-controller to one thread in this order; correct the addf lines" +
          unseen);
    if (wiring_.signal_of.contains("motion.homing-inhibit"))
      refuse(
          "[HAL]HALFILE: a HAL file connects motion.homing-inhibit; remove this connection. Only "
          "the mdof component may connect this pin, to prevent homing while an offset is active");
    const std::string at = " " + thread + " ";
    live_.hal =
        "# Live compensation by mdof. This file must be the last HALFILE of [HAL].\n"
        "loadrt mdof_compensation\n"
        "addf mdof-compensation.feedback" +
        at + std::to_string(*reads) + "\naddf mdof-compensation.command" + at +
        std::to_string(*moves + 2) + "\n";
    for (const auto& [name, value] : {std::pair{"max-offset", live_.max_offset},
                                      {"max-velocity", live_.max_velocity},
                                      {"max-acceleration", live_.max_acceleration},
                                      {"fade-velocity", live_.fade_velocity}})
      live_.hal +=
          "setp mdof-compensation." + std::string(name) + " " + plain_number(value, 9) + "\n";
    net("mdof-homed", "motion.is-all-homed", "all-homed");
    net("mdof-on", "motion.motion-enabled", "machine-on");
    live_.hal +=
        "net mdof-homing-inhibit mdof-compensation.homing-inhibit => motion.homing-inhibit\n";
    for (const LiveJoint& joint : live_.joints) write_joint(joint, unseen);
    write_loader();
  }

  void write_joint(const LiveJoint& joint, const std::string& unseen) {
    const std::string of = "joint." + std::to_string(joint.joint) + ".";
    const std::string k(1, static_cast<char>('0' + joint.axis - 'X' + (joint.second ? 3 : 0)));
    const std::string name = std::string("mdof-") + static_cast<char>(joint.axis - 'X' + 'x') +
                             (joint.second ? "2" : "");
    const std::string command = wiring_.signal(of + "motor-pos-cmd", "");
    const std::string feedback = wiring_.signal(of + "motor-pos-fb", "");
    for (const auto& [pin, signal] :
         {std::pair{"motor-pos-cmd", command}, {"motor-pos-fb", feedback}})
      if (signal.empty()) refuse("[HAL]HALFILE: no HAL file connects (net) " + of + pin + unseen);
    live_.hal += std::string("# ") + joint.axis + (joint.second ? ", second joint" : "") +
                 "\nunlinkp " + of + "motor-pos-cmd\nunlinkp " + of + "motor-pos-fb\nnet " + name +
                 "-command " + of + "motor-pos-cmd => mdof-compensation.pos-in-" + k + "\nnet " +
                 command + " mdof-compensation.pos-out-" + k + "\nnet " + feedback +
                 " => mdof-compensation.fb-in-" + k + "\nnet " + name +
                 "-feedback mdof-compensation.fb-out-" + k + " => " + of + "motor-pos-fb\n";
    if (!joint.second) net(name + "-position", of + "pos-cmd", "joint-pos-" + k);
    net(name + "-homing", of + "homing", "homing-" + k);
  }

  void write_loader() {
    live_.hal += "loadusr -Wn mdof-compensation-loader mdof_compensation_loader --axis-velocity";
    for (const char axis : std::string_view("XYZ")) {
      const auto found = std::find_if(live_.joints.begin(), live_.joints.end(),
                                      [axis](const LiveJoint& j) { return j.axis == axis; });
      live_.hal += found == live_.joints.end() ? " 0" : " [" + section_of(*found) + "]MAX_VELOCITY";
    }
    live_.hal += " --socket " + request_.socket + (live_.inch ? " --inch" : "") +
                 (request_.simulated ? " --simulated" : "") +
                 (request_.despite_warnings ? " --despite-warnings" : "") +
                 (request_.one_approach ? " --one-approach" : "") + "\n";
  }

  const LinuxCncIni& ini_;
  const HalWiring& wiring_;
  const LiveRequest& request_;
  LiveCompensation live_;
  std::vector<std::string> refused_;
  double unit_ = 1, period_s_ = 1e-3;
};

}  // namespace

Result<LiveCompensation> live_compensation(const LinuxCncIni& ini, const HalWiring& wiring,
                                           const LiveRequest& request) {
  return LiveLimits(ini, wiring, request).live();
}

}  // namespace mdof::tools
