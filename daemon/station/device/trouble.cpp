#include "daemon/station/device/trouble.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "algo/points/flags.h"
#include "schema/base/json_writer.h"
#include "schema/units.h"

namespace mdof::daemon {
namespace {

using Kind = Trouble::Kind;

constexpr std::chrono::seconds kQuiet{10};

std::string whose(const std::string& device) {
  return device.empty() ? "" : "device \"" + device + "\": ";
}

std::string number_mm(double x_m) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f mm", to_mm(x_m));
  return text;
}

std::string join(const std::vector<std::string>& words) {
  std::string all;
  for (const auto& word : words) all += (all.empty() ? "" : ", ") + word;
  return all;
}

// The device that provides all these channels. "": no device provides all of them, or the axis has
// only one device.
std::string source_of(const std::vector<std::string>& ids, const ChannelsByDevice& channels) {
  if (channels.size() < 2) return "";
  for (const auto& [device, of_device] : channels) {
    const auto& given = of_device;  // in clang 14, a lambda cannot capture a structured binding
    const auto gives = [&](const std::string& id) {
      return std::find(given.begin(), given.end(), id) != given.end();
    };
    if (std::all_of(ids.begin(), ids.end(), gives)) return device;
  }
  return "";
}

}  // namespace

std::optional<Trouble> unsolved(const MeasuredPoint& point, const Rig& rig,
                                const ChannelsByDevice& channels, const std::string& utc) {
  if (point.errors.valid) return std::nullopt;
  std::vector<std::string> silent, saturated, all;
  for (std::size_t k = 0; k < rig.probes.size() && k < point.point.probe_m.size(); ++k) {
    if (!std::isnan(point.point.probe_m[k])) continue;
    const std::string& id = rig.probes[k].id;
    (algo::has_flag(point.point, Flag::saturated, id) ? saturated : silent).push_back(id);
    all.push_back(id);
  }
  std::string text = "the stop at " + number_mm(point.point.position_m) + " has no error values: ";
  if (!silent.empty()) text += "no usable readings from probe " + join(silent);
  if (!saturated.empty())
    text += (silent.empty() ? "" : "; ") + ("probe at the end of its range: " + join(saturated));
  if (all.empty()) text += point.errors.reason;
  return Trouble{Kind::unsolved, all.empty() ? "" : source_of(all, channels), text, utc};
}

const char* to_string(Kind kind) {
  switch (kind) {
    case Kind::lost:
      return "lost";
    case Kind::back:
      return "back";
    case Kind::suspect:
      return "suspect";
    case Kind::slow:
      return "slow";
    case Kind::position:
      return "position";
    case Kind::missing:
      return "missing";
    case Kind::clock:
      return "clock";
    case Kind::unsolved:
      break;
  }
  return "unsolved";
}

std::string trouble_line(const Trouble& trouble) {
  return whose(trouble.device) + to_string(trouble.kind) + ": " + trouble.text;
}

std::string trouble_json(Axis axis, std::int64_t run, const Trouble& trouble) {
  JsonWriter json;
  json.begin_object().field("type", "trouble").field("axis", std::string(1, letter(axis)));
  json.key("run");
  run > 0 ? json.value(run) : json.null();
  json.field("device", trouble.device)
      .field("kind", to_string(trouble.kind))
      .field("text", trouble.text)
      .field("utc", trouble.utc)
      .end_object();
  return json.take();
}

// The end of a trouble of one channel is not the return of the device.
void TroubleLog::add(const Trouble& trouble) {
  if (trouble.kind == Kind::back && !trouble.channel.empty()) return;
  if (!devices_.contains(trouble.device)) order_.push_back(trouble.device);
  RepeatedTrouble& story = devices_[trouble.device][trouble.kind];
  if (story.times++ == 0) story.first = trouble;
  story.last = trouble;
}

Notices TroubleLog::summary() const {
  Notices notices;
  for (const auto& device : order_) {
    const auto& kinds = devices_.at(device);
    const auto back = kinds.find(Kind::back);
    for (const auto& [kind, story] : kinds) {
      if (kind == Kind::back) continue;
      const bool recovered = back != kinds.end() && back->second.last.utc >= story.last.utc;
      const std::string end = kind != Kind::lost ? ""
                              : recovered        ? back->second.last.text
                                          : "the device had not recovered when the run ended";
      notices.push_back(notice(NoticeCode::device_trouble, device,
                               {{"kind", to_string(kind)},
                                {"times", story.times},
                                {"utc", story.first.utc},
                                {"reason", story.first.text},
                                {"end", end}}));
    }
  }
  return notices;
}

std::optional<std::string> JournalLimit::admit(const std::string& key, const std::string& line,
                                               Time now) {
  Row& row = rows_[key];
  if (now < row.next) {
    ++row.left_out;
    return std::nullopt;
  }
  std::string text = line;
  if (row.left_out > 0) text += " (and " + std::to_string(row.left_out) + " more times before)";
  row = {now + kQuiet, 0};
  return text;
}

}  // namespace mdof::daemon
