#include "tools/mdof/commands/measure/live_view.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "schema/base/output/printable.h"
#include "tools/mdof/stored/json_read.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

using simdjson::dom::array;
using simdjson::dom::element;
using simdjson::dom::object;

constexpr std::size_t kFewestBar = 11, kMostBar = 81;
constexpr std::size_t kColumnsBesideBar = 50;  // characters in the line of a probe besides its bar

void read_probes(const element& value, LiveUpdate& update) {
  array probes;
  if (value.at_key("probes").get_array().get(probes)) return;
  for (const element p : probes) {
    const double half_um = number(p, "range_um") / 2;
    update.probes.push_back(
        {text(p, "id"), text(p, "quality"), number(p, "um"), -half_um, half_um});
  }
}

void read_errors(const element& value, LiveUpdate& update) {
  object errors;
  if (value.at_key("errors").get_object().get(errors)) return;
  for (const auto [key, x] : errors) {
    double known;
    if (!x.get_double().get(known)) update.errors.emplace_back(key, known);
  }
}

std::string head_line(const LiveUpdate& u) {
  std::string line = u.axis + " at " + fixed(u.encoder_mm, 4) + " mm, ";
  if (std::isnan(u.encoder_mm))
    line = u.axis + ": position unknown, because the encoder sends no position";
  else
    line += u.still ? "at rest" : "moving";
  const bool doubtful = u.encoder_quality == "suspect" || u.encoder_quality == "over_range";
  if (doubtful) line += ", position " + u.encoder_quality;
  if (u.run) line += ", run " + std::to_string(*u.run);
  if (u.simulated) line += ", SIMULATED";
  if (u.stale) line += ", STALE: the values are " + fixed(u.age_s, 1) + " s old";
  return line + (u.waiting_for.empty() ? "" : ", waiting for " + u.waiting_for);
}

// Joins the parts to lines of at most `columns` characters. A part is not divided.
std::string packed(const std::vector<std::string>& parts, std::size_t columns) {
  std::string out, line;
  for (const auto& part : parts) {
    if (!line.empty() && text_width(line) + 2 + text_width(part) > columns) {
      out += line + "\n";
      line = "  " + part;
    } else {
      line += (line.empty() ? "" : "  ") + part;
    }
  }
  return out + line + "\n";
}

std::vector<std::string> errors_of(const LiveUpdate& u) {
  std::vector<std::string> words;
  for (const auto& [key, x] : u.errors) {
    const bool angle = key.ends_with("_urad");
    words.push_back(key.substr(0, key.find('_')) + " " + fixed(x, angle ? 3 : 4) +
                    (angle ? " µrad" : " µm"));
  }
  if (words.empty()) words.emplace_back("errors unknown");
  return words;
}

std::string trouble_of(const LiveUpdate& u, std::size_t columns) {
  std::string lines;
  for (const auto& line : u.trouble) lines += wrapped(line, columns, 2) + "\n";
  return lines;
}

std::string log_entry(const LiveUpdate& u, std::size_t columns) {
  std::vector<std::string> parts = {wrapped(head_line(u), columns, 2)};
  for (const auto& p : u.probes)
    parts.push_back(p.id + " " + fixed(p.um, 3) + " µm" +
                    (p.quality == "good" || p.quality == "simulated" ? "" : " " + p.quality));
  return packed(parts, columns);
}

std::size_t bar_width(std::size_t columns) {
  const std::size_t room = columns > kColumnsBesideBar ? columns - kColumnsBesideBar : 0;
  return std::clamp(room, kFewestBar, kMostBar) / 2 * 2 - 1;  // odd, so that the bar has a middle
}

std::string block(const LiveUpdate& u, std::size_t columns) {
  const std::size_t width = bar_width(columns);
  TextTable table({"probe", "reading/µm", "low ... high", "low/µm", "high/µm", "quality"});
  for (const auto& p : u.probes)
    table.add({p.id, fixed(p.um, 3), range_bar(p.um, p.low_um, p.high_um, width),
               fixed(p.low_um, 0), fixed(p.high_um, 0), p.quality});
  return wrapped(head_line(u), columns, 2) + "\n" + table.text() + packed(errors_of(u), columns) +
         trouble_of(u, columns) + "\n";
}

}  // namespace

std::optional<LiveUpdate> read_update(std::string_view notification) {
  simdjson::dom::parser parser;
  element root, value;
  if (parser.parse(simdjson::padded_string(notification)).get(root)) return std::nullopt;
  if (text(root, "method") != "live.update") return std::nullopt;
  if (root["params"]["value"].get(value)) return std::nullopt;
  LiveUpdate update;
  update.json = simdjson::to_string(value);
  update.axis = text(value, "axis");
  update.encoder_mm = number(value, "encoder_mm");
  update.encoder_quality = text(value, "encoder_quality");
  update.age_s = number(value, "age_s");
  update.waiting_for = text(value, "waiting_for");
  update.still = flag(value, "still");
  update.simulated = flag(value, "simulated");
  update.stale = flag(value, "stale");
  update.run = integer(value, "run");
  update.trouble = texts(value, "trouble");
  read_probes(value, update);
  read_errors(value, update);
  return update;
}

std::optional<TroubleEvent> read_trouble(std::string_view notification) {
  simdjson::dom::parser parser;
  element root, value;
  if (parser.parse(simdjson::padded_string(notification)).get(root)) return std::nullopt;
  if (text(root, "method") != "run.event" || root["params"]["value"].get(value))
    return std::nullopt;
  const std::string type = text(value, "type"), axis = text(value, "axis");
  if (type == "left_out")
    return TroubleEvent{axis, "axis " + axis + ": " + text(value, "text"),
                        simdjson::to_string(value)};
  if (type != "trouble") return std::nullopt;
  const std::string device = text(value, "device");
  const std::string line = text(value, "utc") + " axis " + axis + ": " +
                           (device.empty() ? "" : "device \"" + device + "\": ") +
                           text(value, "kind") + ": " + text(value, "text");
  return TroubleEvent{axis, line, simdjson::to_string(value)};
}

void ProbeRanges::add(const std::string& axis, const std::string& rig) {
  simdjson::dom::parser parser;
  element root;
  array probes;
  if (parser.parse(simdjson::padded_string(rig)).get(root)) return;
  if (root["probes"].get_array().get(probes)) return;
  for (const element p : probes)
    ends_um_[{axis, text(p, "id")}] = {number(p, "low_um"), number(p, "high_um")};
}

void ProbeRanges::apply(LiveUpdate& update) const {
  for (auto& probe : update.probes) {
    const auto ends = ends_um_.find({update.axis, probe.id});
    if (ends != ends_um_.end()) std::tie(probe.low_um, probe.high_um) = ends->second;
  }
}

std::string range_bar(double um, double low_um, double high_um, std::size_t width) {
  std::string bar(width, '.');
  bar[width / 2] = '+';
  if (!std::isfinite(um) || !(high_um > low_um)) return "|" + std::string(width, ' ') + "|";
  const double share = (um - low_um) / (high_um - low_um);
  if (share <= 0) return "<" + bar + "|";
  if (share >= 1) return "|" + bar + ">";
  bar[std::min(static_cast<std::size_t>(share * static_cast<double>(width)), width - 1)] = '#';
  return "|" + bar + "|";
}

std::string LiveScreen::next(const LiveUpdate& update) {
  if (!terminal_) return printable(log_entry(update, columns_));
  blocks_[update.axis] = printable(block(update, columns_));
  std::string all;
  for (const auto& [axis, lines] : blocks_) all += lines;
  const std::string up = lines_ > 0 ? "\x1b[" + std::to_string(lines_) + "A" : "";
  lines_ = static_cast<std::size_t>(std::count(all.begin(), all.end(), '\n'));
  std::string drawn = up;
  for (const char c : all) drawn += c == '\n' ? std::string("\x1b[K\n") : std::string(1, c);
  return drawn;
}

}  // namespace mdof::tools
