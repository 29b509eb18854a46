#include "tools/mdof/live_view.h"

#include <algorithm>
#include <cmath>

#include "tools/mdof/json_read.h"
#include "tools/mdof/text_table.h"

namespace mdof::tools {
namespace {

using simdjson::dom::array;
using simdjson::dom::element;
using simdjson::dom::object;

constexpr int kBarWidth = 41;  // odd: it has a middle

void read_probes(const element& value, LiveUpdate& update) {
  array probes;
  if (value.at_key("probes").get_array().get(probes)) return;
  for (const element p : probes)
    update.probes.push_back(
        {text(p, "id"), text(p, "quality"), number(p, "um"), number(p, "range_um")});
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
  std::string line =
      u.axis + " at " + fixed(u.encoder_mm, 4) + " mm, " + (u.still ? "at rest" : "moving");
  if (u.run) line += ", run " + std::to_string(*u.run);
  return line + (u.simulated ? ", SIMULATED" : "") + (u.stale ? ", STALE: no new values" : "");
}

std::string errors_line(const LiveUpdate& u) {
  std::vector<std::string> words;
  for (const auto& [key, x] : u.errors) {
    const bool angle = key.ends_with("_urad");
    words.push_back(key.substr(0, key.find('_')) + " " + fixed(x, angle ? 3 : 4) +
                    (angle ? " µrad" : " µm"));
  }
  return words.empty() ? "errors not solved" : joined(words, "  ");
}

std::string one_line(const LiveUpdate& u) {
  std::string line = head_line(u);
  for (const auto& p : u.probes)
    line += "  " + p.id + " " + fixed(p.um, 3) + " µm " + range_bar(p.um, p.range_um);
  return line + "\n";
}

std::string block(const LiveUpdate& u) {
  TextTable table({"probe", "reading/µm", "-range/2 ... +range/2", "range/µm", "quality"});
  for (const auto& p : u.probes)
    table.add({p.id, fixed(p.um, 3), range_bar(p.um, p.range_um), fixed(p.range_um, 0), p.quality});
  return head_line(u) + "\n" + table.text() + errors_line(u) + "\n\n";
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
  update.still = flag(value, "still");
  update.simulated = flag(value, "simulated");
  update.stale = flag(value, "stale");
  update.run = integer(value, "run");
  read_probes(value, update);
  read_errors(value, update);
  return update;
}

std::string range_bar(double um, double range_um) {
  std::string bar(kBarWidth, '.');
  bar[kBarWidth / 2] = '+';
  if (!std::isfinite(um) || !(range_um > 0)) return "|" + std::string(kBarWidth, ' ') + "|";
  const double share = um / range_um + 0.5;
  if (share <= 0) return "<" + bar + "|";
  if (share >= 1) return "|" + bar + ">";
  bar[std::min(static_cast<std::size_t>(share * kBarWidth), bar.size() - 1)] = '#';
  return "|" + bar + "|";
}

std::string LiveScreen::next(const LiveUpdate& update) {
  if (!terminal_) return one_line(update);
  blocks_[update.axis] = block(update);
  std::string all;
  for (const auto& [axis, lines] : blocks_) all += lines;
  const std::string up = lines_ > 0 ? "\x1b[" + std::to_string(lines_) + "A" : "";
  lines_ = static_cast<std::size_t>(std::count(all.begin(), all.end(), '\n'));
  std::string drawn = up;
  for (const char c : all) drawn += c == '\n' ? std::string("\x1b[K\n") : std::string(1, c);
  return drawn;
}

}  // namespace mdof::tools
