#include "daemon/measure/replay/request_json.h"

#include <simdjson.h>

#include <cmath>
#include <limits>
#include <set>

#include "schema/base/json_writer.h"
#include "schema/notice/notice_json.h"
#include "schema/units.h"

namespace mdof::daemon {
namespace {

using simdjson::dom::element;

constexpr double kMostDelay_s = 10;  // same limit as in delays.cpp

// Reads the members of an object into variables. The error is the first member with a wrong type.
// If a member is missing or null, its variable does not change.
class Members {
 public:
  // `path`: path of the object for messages, with a dot at the end ("options.").
  explicit Members(element object, std::string path = "")
      : object_(object), path_(std::move(path)) {}

  // Call done() after take() of all known members. Error: a member is unknown, so that its effect
  // is unknown, or a member occurs twice, so that one of the two values would be ignored.
  Status done() {
    std::set<std::string_view> seen;
    for (const auto member : object_.get_object()) {
      if (!asked_.contains(member.key))
        reject(member.key,
               "is unknown to this version of mdof; use a newer version, or restore the file from "
               "a backup");
      else if (!seen.insert(member.key).second)
        reject(member.key, "occurs twice");
    }
    return status_;
  }

  template <class T>
  void take(const char* key, T& to) {
    const auto found = find(key);
    if (found && found->get(to)) reject(key);
  }
  void take(const char* key, std::string& to) {
    std::string_view text(to);
    take(key, text);
    to = std::string(text);
  }
  void take(const char* key, double& to_si, double (*from)(double)) {
    double x = std::nan("");
    take(key, x);
    if (!std::isnan(x)) to_si = from(x);
  }
  void take_not_negative(const char* key, double& to_si, double (*from)(double)) {
    take(key, to_si, from);
    if (to_si < 0) reject(key);
  }
  template <class Take>
  void each(const char* key, Take take_item) {
    const auto found = find(key);
    simdjson::dom::array items;
    if (!found) return;
    if (found->get(items)) return reject(key);
    for (const element item : items)
      if (!take_item(item)) return reject(key);
  }
  std::optional<element> find(const char* key) {
    asked_.insert(key);
    element found;
    if (object_[key].get(found) || found.is_null()) return std::nullopt;
    return found;
  }
  std::optional<element> object(const char* key) {
    const auto found = find(key);
    if (!found || found->is_object()) return found;
    reject(key);
    return std::nullopt;
  }
  void reject(std::string_view key,
              const char* why = "has a wrong type or value; restore the file from a backup") {
    if (status_) status_ = bad_input("key \"" + path_ + std::string(key) + "\" " + why);
  }

 private:
  element object_;
  std::string path_;
  std::set<std::string_view> asked_;
  Status status_;
};

double seconds(double x_s) {
  return x_s;
}

// Reads an object with one number for each channel.
void read_by_channel(Members& members, const char* key, std::map<std::string, double>& to,
                     bool (*good)(double)) {
  const auto found = members.object(key);
  simdjson::dom::object channels;
  // If the member is not an object, object() has reported the error.
  if (!found || found->get(channels)) return;
  to.clear();
  for (const auto member : channels) {
    double x = 0;
    const bool is_number = !member.value.get(x);
    const bool is_new = to.emplace(member.key, x).second;
    if (!is_number || !is_new || !good(x)) members.reject(key);
  }
}

Status read_align(element object, algo::AlignOptions& align) {
  Members members(object, "options.align.");
  members.take_not_negative("lag_bound_s", align.lag_bound_s, seconds);
  members.take_not_negative("max_gap_s", align.max_gap_s, seconds);
  read_by_channel(members, "interval_s", align.interval_s, [](double s) { return s > 0; });
  read_by_channel(members, "delay_s", align.delay_s,
                  [](double s) { return std::abs(s) <= kMostDelay_s; });
  return members.done();
}

Status read_dwell(element object, algo::DwellOptions& dwell) {
  Members members(object, "options.dwell.");
  members.take_not_negative("tolerance_um", dwell.tolerance_m, from_um);
  members.take_not_negative("window_s", dwell.window_s, seconds);
  members.take_not_negative("settle_s", dwell.settle_s, seconds);
  members.take_not_negative("min_length_s", dwell.min_length_s, seconds);
  members.take_not_negative("leave_s", dwell.leave_s, seconds);
  members.take_not_negative("approach_um", dwell.approach_m, from_um);
  members.take("max_speed_mm_s", dwell.max_speed_m_s, from_mm);
  if (!(dwell.max_speed_m_s > 0)) members.reject("max_speed_mm_s");
  std::uint64_t max_scans = dwell.max_scans;
  members.take("max_scans", max_scans);
  if (max_scans == 0) members.reject("max_scans");
  dwell.max_scans = max_scans;
  return members.done();
}

void read_targets(Members& members, PipelineOptions& options) {
  if (members.find("targets_mm")) options.sequence.targets_m.clear();
  members.each("targets_mm", [&](element item) {
    double target_mm = 0;
    if (item.get(target_mm)) return false;
    options.sequence.targets_m.push_back(from_mm(target_mm));
    return true;
  });
  members.take_not_negative("target_window_mm", options.sequence.target_window_m, from_mm);
  // Runs of older versions have no member "repeats". A user ended these runs.
  std::int64_t repeats = options.repeats;
  members.take("repeats", repeats);
  if (repeats < 0 || repeats > std::numeric_limits<int>::max()) members.reject("repeats");
  options.repeats = static_cast<int>(repeats);
}

// The member "kind" is required. The default would mean an absolute encoder.
Status read_datum(element object, EncoderDatum& datum) {
  Members members(object, "options.encoder_datum.");
  datum = {};
  std::string kind;
  members.take("kind", kind);
  if (!datum_kind_from(kind, datum.kind)) members.reject("kind");
  members.take("offset_mm", datum.offset_m, from_mm);
  members.take("device", datum.device);
  members.take("utc", datum.utc);
  members.take("by", datum.by);
  return members.done();
}

Status read_on_the_fly(element object, std::optional<algo::OnTheFlyOptions>& to) {
  Members members(object, "options.on_the_fly.");
  algo::OnTheFlyOptions options;
  members.take("interval_mm", options.interval_mm);
  members.take("bin_mm", options.bin_mm);
  for (const auto& [key, end] :
       {std::pair("from_mm", &options.from_mm), std::pair("to_mm", &options.to_mm)}) {
    double at_mm = std::nan("");
    members.take(key, at_mm);
    if (!std::isnan(at_mm)) *end = at_mm;
  }
  to = options;
  return members.done();
}

Result<PipelineOptions> read_options(element object, PipelineOptions options) {
  Members members(object, "options.");
  std::string model = to_string(options.model);
  members.take("model", model);
  if (!model_from(model, options.model)) members.reject("model");
  if (const auto align = members.object("align")) MDOF_CHECK(read_align(*align, options.align));
  if (const auto dwell = members.object("dwell")) MDOF_CHECK(read_dwell(*dwell, options.dwell));
  read_targets(members, options);
  members.take("remove_drift", options.remove_drift);
  if (const auto on_the_fly = members.object("on_the_fly"))
    MDOF_CHECK(read_on_the_fly(*on_the_fly, options.on_the_fly));
  if (const auto datum = members.object("encoder_datum"))
    MDOF_CHECK(read_datum(*datum, options.datum));
  MDOF_CHECK(members.done());
  return options;
}

Result<element> parsed(simdjson::dom::parser& parser, const std::string& text) {
  element root;
  if (parser.parse(simdjson::padded_string(text)).get(root) || !root.is_object())
    return bad_input(
        "this text is not a JSON object; the text is damaged, or mdof did not write it");
  return root;
}

}  // namespace

std::string request_json(const RecordedRequest& asked) {
  JsonWriter json;
  json.begin_object().field("note", asked.note);
  write_notices(json, "notices", asked.notices, nullptr);
  json.key("options").raw(asked.options.json()).end_object();
  return json.take();
}

Result<RecordedRequest> read_request_json(const std::string& text, const PipelineOptions& base) {
  RecordedRequest asked;
  asked.options = base;
  if (text.empty()) return asked;
  simdjson::dom::parser parser;
  MDOF_TRY(const element root, parsed(parser, text));
  Members members(root);
  members.take("note", asked.note);
  // Older recordings have the member "warnings", with sentences.
  for (const char* key : {"warnings", "notices"}) {
    const auto list = members.find(key);
    if (!list) continue;
    auto notices = read_notices(simdjson::minify(*list));
    if (notices)
      append(asked.notices, std::move(*notices));
    else
      members.reject(key);
  }
  if (const auto options = members.object("options")) {
    MDOF_TRY(asked.options, read_options(*options, base));
  }
  MDOF_CHECK(members.done());
  return asked;
}

Result<PipelineOptions> read_options_json(const std::string& text, const PipelineOptions& base) {
  simdjson::dom::parser parser;
  MDOF_TRY(const element root, parsed(parser, text));
  return read_options(root, base);
}

}  // namespace mdof::daemon
