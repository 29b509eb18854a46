#include "daemon/station/run_events.h"

#include <span>

#include "schema/base/json_page.h"
#include "schema/run_json.h"

namespace mdof::daemon {
namespace {

// As many points as a line holds, from `next` on, which is moved on.
std::string points_json(std::int64_t run, const MovingAxis& moving,
                        const std::vector<MeasuredPoint>& points, std::size_t first_row,
                        std::size_t& next) {
  JsonWriter json;
  json.begin_object()
      .field("type", "points")
      .field("run", run)
      .field("axis", std::string(1, letter(moving.axis)))
      .field("offset", static_cast<std::uint64_t>(first_row + next))
      .field("reference", to_string(Reference::fixture));
  json.key("points").begin_array();
  next += append_page(json, std::span(points).subspan(next), [&](const MeasuredPoint& point) {
    JsonWriter item;
    write_point(item, moving, point);
    return item.take();
  });
  json.end_array().end_object();
  return json.take();
}

}  // namespace

std::vector<std::string> points_messages(std::int64_t run, const MovingAxis& moving,
                                         const std::vector<MeasuredPoint>& points,
                                         std::size_t first_row) {
  std::vector<std::string> messages;
  for (std::size_t next = 0; next < points.size();)
    messages.push_back(points_json(run, moving, points, first_row, next));
  return messages;
}

}  // namespace mdof::daemon
