// The method squareness.fit.
#include "daemon/measure/evaluation.h"
#include "daemon/methods/methods.h"
#include "schema/units.h"

namespace mdof::daemon {
namespace {

using rpc::Params;
using rpc::ParamType;
using rpc::Reply;

void squareness(Methods& m, const Params& params, Reply reply) {
  auto asked = squareness_param(params);
  if (!asked) return reply(tl::unexpected(asked.error()));
  SquarenessRequest request = std::move(*asked);
  if (params.has("artefact_angle_error_urad"))
    request.given.angle_error_rad = from_urad(params.number("artefact_angle_error_urad"));
  // Clients of earlier versions use the second name.
  for (const char* key : {"u_artefact_angle_urad", "u_artefact_urad"})
    if (params.has(key)) request.given.u_rad = from_urad(params.number(key));
  request.action = caller_action(params, "squareness.fit");
  answer_with_change(m, std::move(reply), [request](store::Store& reader) -> Result<Change> {
    MDOF_TRY(auto found, calculate_squareness(reader, request));
    MDOF_TRY(const auto by_line, squareness_by_reference_line(reader, found.squareness));
    return [fitted = std::move(found), lines = by_line,
            action = request.action](store::Store& store) mutable -> Result<std::string> {
      MDOF_CHECK(store_squareness(store, fitted.squareness, action));
      return squareness_document(fitted, lines);
    };
  });
}

constexpr std::array kRunKeys = {"run_x", "run_y", "run_z"};

// The request with run_a and run_b. The axes are read from the runs.
Result<SquarenessRequest> runs_in_order(const Params& params, bool named_by_axis) {
  if (named_by_axis || !params.has("run_a") || !params.has("run_b"))
    return fail(ErrorCode::usage,
                "squareness needs runs of two axes; give run_a and run_b, or two of run_x, run_y "
                "and run_z");
  SquarenessRequest request;
  request.run_a = params.integer("run_a");
  request.run_b = params.integer("run_b");
  request.partial = params.boolean("partial", false);
  return request;
}

}  // namespace

std::vector<rpc::Param> squareness_params(std::vector<rpc::Param> more) {
  std::vector<rpc::Param> all = {{"run_x", ParamType::integer,
                                  "id of the run along X; give two of run_x, run_y, run_z", false},
                                 {"run_y", ParamType::integer, "id of the run along Y", false}};
  all.insert(all.end(), more.begin(), more.end());
  all.push_back({"partial", ParamType::boolean, "also accept partial runs", false, "false"});
  all.push_back({"run_z", ParamType::integer, "id of the run along Z", false});
  all.push_back({"run_a", ParamType::integer,
                 "id of the run along the axis that is first in the order X, Y, Z; give either "
                 "run_a and run_b, or two of run_x, run_y and run_z",
                 false});
  all.push_back({"run_b", ParamType::integer, "id of the run along the other axis", false});
  return all;
}

Result<SquarenessRequest> squareness_param(const Params& params) {
  std::vector<std::size_t> given;
  for (std::size_t axis = 0; axis < kRunKeys.size(); ++axis)
    if (params.has(kRunKeys[axis])) given.push_back(axis);
  if (params.has("run_a") || params.has("run_b")) return runs_in_order(params, !given.empty());
  if (given.size() != 2)
    return fail(ErrorCode::usage,
                "squareness needs runs of two axes; give run_a and run_b, or two of run_x, run_y "
                "and run_z");
  SquarenessRequest request;
  request.axes = {static_cast<Axis>(given[0]), static_cast<Axis>(given[1])};
  request.run_a = params.integer(kRunKeys[given[0]]);
  request.run_b = params.integer(kRunKeys[given[1]]);
  request.partial = params.boolean("partial", false);
  return request;
}

void add_squareness_methods(rpc::MethodTable& table, Methods& m) {
  std::vector<rpc::Param> fit =
      squareness_params({{"artefact_angle_error_urad", ParamType::number,
                          "angle error of the square: the angle between its two faces, inside the "
                          "material, is 90 deg + this value [value in the rigs]",
                          false},
                         {"u_artefact_angle_urad",
                          ParamType::number,
                          "standard uncertainty of the angle of the square [value in the rigs]",
                          false,
                          {},
                          {.least = 0}}});
  fit.push_back({"u_artefact_urad",
                 ParamType::number,
                 "earlier name of u_artefact_angle_urad",
                 false,
                 {},
                 {.least = 0}});
  table.add(
      {.name = "squareness.fit",
       .summary = "Calculates the squareness of two axes from a run along each axis, and stores "
                  "the squareness with its standard uncertainty. X and Y give EC0Y, X and Z give "
                  "EB0Z, Y and Z give EA0Z. An identical result is stored only once.",
       .params = std::move(fit),
       .result = "the squareness and the slopes are valid at the position of the measuring fixture",
       .members =
           "{squareness!, run_{small}, E{angular}0{axis}_urad, u_E{angular}0{axis}_urad, "
           "u_random_E{angular}0{axis}_urad, U_E{angular}0{axis}_urad, k, nu_eff, ...covers, "
           "noise_only, "
           "form_urad, reference, slope_E{linear}{axis}_urad, u_slope_E{linear}{axis}_urad, "
           "square_tilt_urad, artefact_angle_error_urad, u_artefact_angle_urad, artefact_corner, "
           "...stated_figures, "
           "slopes_over, sense, simulated, created_utc, ...notices, lines: {end_point: "
           "squareness_line, least_squares: squareness_line, minimum_zone: squareness_line}}",
       .example = R"({"run_x": 1, "run_y": 2})",
       .writes = true,
       .handler = [&m](const Params& p, Reply r) { squareness(m, p, std::move(r)); }});
}

}  // namespace mdof::daemon
