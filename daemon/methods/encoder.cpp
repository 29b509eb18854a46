// The method encoder.set.
#include <cstdio>

#include "daemon/methods/methods.h"
#include "schema/base/json_writer.h"
#include "schema/units.h"

namespace mdof::daemon {
namespace {

using rpc::Params;
using rpc::ParamType;
using rpc::Reply;

constexpr double kFarthest_mm = 1e6;

std::string datum_reply(Axis axis, double position_mm, const EncoderDatum& datum) {
  JsonWriter json;
  json.begin_object()
      .field("axis", std::string(1, letter(axis)))
      .field("device", datum.device)
      .field("position_mm", position_mm)
      .field("offset_mm", to_mm(datum.offset_m))
      .field("utc", datum.utc)
      .end_object();
  return json.take();
}

void set_encoder(Methods& m, const Params& params, Reply reply) {
  const auto axis = axis_param(params);
  if (!axis) return reply(tl::unexpected(axis.error()));
  const auto station = find_station(m, *axis);
  if (!station) return reply(tl::unexpected(station.error()));
  const double position_mm = params.number("position_mm");
  const HistoryEntry action = caller_action(params, "encoder.set");
  auto shared = std::make_shared<Reply>(std::move(reply));
  (*station)->set_encoder(from_mm(position_mm), action, [=](const Result<EncoderDatum>& set) {
    if (!set) return (*shared)(tl::unexpected(set.error()));
    std::fprintf(
        stderr,
        "axis %c: the encoder position was set to %.4f mm by %s (the offset is now %.4f mm)\n",
        letter(*axis), position_mm, set->by.c_str(), to_mm(set->offset_m));
    (*shared)(datum_reply(*axis, position_mm, *set));
  });
}

}  // namespace

void add_encoder_methods(rpc::MethodTable& table, Methods& m) {
  table.add({.name = "encoder.set",
             .summary =
                 "Sets the present position of an axis that has an incremental encoder. The "
                 "setting is lost when the device of the encoder loses power or mdofd restarts.",
             .params = {{"axis", ParamType::string, "X, Y or Z", true},
                        {"position_mm",
                         ParamType::number,
                         "present position in machine coordinates; the axis must stand still",
                         true,
                         {},
                         {.least = -kFarthest_mm, .most = kFarthest_mm}}},
             .members = "{axis, device, position_mm: number, offset_mm, utc}",
             .example = R"({"axis": "X", "position_mm": 12.5})",
             .writes = true,
             .handler = [&m](const Params& p, Reply r) { set_encoder(m, p, std::move(r)); }});
}

}  // namespace mdof::daemon
