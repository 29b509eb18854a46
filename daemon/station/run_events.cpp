#include "daemon/station/run_events.h"

#include <algorithm>
#include <optional>

#include "algo/uncertainty/run_uncertainty.h"
#include "daemon/words/words.h"
#include "schema/base/json_page.h"
#include "schema/base/json_writer.h"
#include "schema/base/number/number_text.h"
#include "schema/notice/notice.h"
#include "schema/run_json.h"
#include "schema/units.h"

namespace mdof::daemon {
namespace {

// A run with the first point and then the new points. The first point is needed, because the drift
// of the run is counted from it.
Run first_and_new(std::int64_t run, const Rig& rig, Model model,
                  const std::vector<MeasuredPoint>& points, std::size_t first_row) {
  Run part;
  part.header.id = run;
  part.header.axis = rig.axis;
  part.header.sides = rig.sides;
  part.header.stated = kAtFixture;
  part.header.provenance.model = to_string(model);
  part.points.push_back(points.front());
  part.points.insert(part.points.end(), points.begin() + static_cast<std::ptrdiff_t>(first_row),
                     points.end());
  return part;
}

// Writes the points from index `next`, as many as a line can contain, and increases `next` by their
// number. Index 0 is the first point of the run.
std::string points_json(const Run& part, const RunUncertainty& uncertainty, std::size_t first_row,
                        std::size_t& next) {
  JsonWriter json;
  json.begin_object()
      .field("type", "points")
      .field("run", part.header.id)
      .field("axis", std::string(1, letter(part.header.axis)))
      .field("offset", static_cast<std::uint64_t>(first_row + next - 1))
      .field("reference", to_string(part.header.stated.reference));
  write_covers(json, uncertainty);
  json.key("points").begin_array();
  next += append_page_by_index(json, next, part.points.size(), [&](std::size_t j) {
    JsonWriter item;
    write_point(item, part.header.moving(), part.points[j], uncertainty.points[j]);
    return item.take();
  });
  json.end_array().end_object();
  return json.take();
}

// Number of requested points that are measured. Only solved points count, and at most `repeats`
// points for each target and approach.
std::size_t done(const RunRequest& request, const std::vector<MeasuredPoint>& points) {
  std::vector<int> ways(2 * request.targets_m.size());
  std::size_t done = 0;
  for (const auto& p : points) {
    if (!p.errors.valid || p.target < 1) continue;
    const auto way = 2 * (static_cast<std::size_t>(p.target) - 1) + (p.point.direction > 0);
    done += way < ways.size() && ways[way]++ < request.repeats;
  }
  return done;
}

// The index of the expected next target: the neighbour in the direction of the last motion. At the
// end of the travel, the same target is expected again.
std::optional<std::size_t> expected_target(const RunRequest& request,
                                           const std::vector<MeasuredPoint>& points) {
  if (request.targets_m.empty()) return std::nullopt;
  if (points.empty()) return 0;
  const auto last = static_cast<std::size_t>(points.back().target) - 1;
  const bool forward = points.back().point.direction > 0;
  if (forward) return std::min(last + 1, request.targets_m.size() - 1);
  return last > 0 ? last - 1 : 0;
}

}  // namespace

std::vector<std::string> points_messages(std::int64_t run, const Rig& rig, Model model,
                                         const std::vector<MeasuredPoint>& points,
                                         std::size_t first_row) {
  std::vector<std::string> messages;
  if (first_row >= points.size()) return messages;
  const Run part = first_and_new(run, rig, model, points, first_row);
  const RunUncertainty uncertainty = algo::stop_uncertainty(rig, part);
  for (std::size_t next = 1; next < part.points.size();)
    messages.push_back(points_json(part, uncertainty, first_row, next));
  return messages;
}

std::string left_out_message(std::int64_t run, Axis axis, double position_m) {
  const double mm = to_mm(position_m);
  const Notice left_out = notice(NoticeCode::stop_near_no_target, "",
                                 {{"stops", 1}, {"positions_mm", plain_number(mm, 9)}});
  JsonWriter json;
  json.begin_object()
      .field("type", "left_out")
      .field("run", run)
      .field("axis", std::string(1, letter(axis)))
      .field("position_mm", mm)
      .field("code", to_string(left_out.code))
      .field("text", words::text(left_out))
      .end_object();
  return json.take();
}

std::string started_message(std::int64_t run, Axis axis) {
  JsonWriter json;
  json.begin_object()
      .field("type", "started")
      .field("run", run)
      .field("axis", std::string(1, letter(axis)))
      .end_object();
  return json.take();
}

std::string ended_message(std::int64_t run, Axis axis, RunState state) {
  JsonWriter json;
  json.begin_object()
      .field("type", "ended")
      .field("run", run)
      .field("axis", std::string(1, letter(axis)))
      .field("state", to_string(state))
      .end_object();
  return json.take();
}

std::string progress_message(std::int64_t run, Axis axis, const RunRequest& request,
                             const std::vector<MeasuredPoint>& points) {
  JsonWriter json;
  json.begin_object()
      .field("type", "progress")
      .field("run", run)
      .field("axis", std::string(1, letter(axis)))
      .field("points", static_cast<std::uint64_t>(points.size()));
  const std::size_t of = 2 * request.targets_m.size() * static_cast<std::size_t>(request.repeats);
  json.key("of");
  of > 0 ? json.value(static_cast<std::uint64_t>(of)) : json.null();
  json.key("done");
  of > 0 ? json.value(static_cast<std::uint64_t>(done(request, points))) : json.null();
  json.key("awaited_mm");
  const auto next = expected_target(request, points);
  next ? json.value(to_mm(request.targets_m[*next])) : json.null();
  json.end_object();
  return json.take();
}

}  // namespace mdof::daemon
