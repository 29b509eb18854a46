// squareness.fit.
#include "daemon/measure/evaluation.h"
#include "daemon/methods/methods.h"
#include "daemon/words/words.h"
#include "schema/run_json.h"
#include "schema/units.h"

namespace mdof::daemon {
namespace {

using rpc::Params;
using rpc::ParamType;
using rpc::Reply;

void squareness(Methods& m, const Params& params, Reply reply) {
  SquarenessRequest request{
      params.integer("run_x"), params.integer("run_y"), {}, params.boolean("partial", false)};
  if (params.has("artefact_angle_error_urad"))
    request.given.angle_error_rad = from_urad(params.number("artefact_angle_error_urad"));
  if (params.has("u_artefact_urad"))
    request.given.u_rad = from_urad(params.number("u_artefact_urad"));
  request.deed = deed_of(params, "squareness.fit");
  answer_with_change(m, std::move(reply), [request](store::Store& reader) -> Result<Change> {
    MDOF_TRY(auto found, calculate_squareness(reader, request));
    return [fitted = std::move(found),
            deed = request.deed](store::Store& store) mutable -> Result<std::string> {
      MDOF_CHECK(store_squareness(store, fitted.squareness, deed));
      return with_notices(squareness_json(fitted.squareness, fitted.budgets), fitted.notices,
                          words::text);
    };
  });
}

}  // namespace

void add_squareness_methods(rpc::MethodTable& table, Methods& m) {
  table.add(
      {.name = "squareness.fit",
       .summary = "Squareness EC0Y of a run along X and one along Y, stored with its "
                  "standard uncertainty. The same fit is stored once.",
       .params = {{"run_x", ParamType::integer, "id of the run along X", true},
                  {"run_y", ParamType::integer, "id of the run along Y", true},
                  {"artefact_angle_error_urad", ParamType::number,
                   "of the square: the material encloses 90 deg + this at the corner of its two "
                   "faces; from the rigs if not given",
                   false},
                  {"u_artefact_urad",
                   ParamType::number,
                   "its standard uncertainty; from the rigs if not given",
                   false,
                   {},
                   {.least = 0}},
                  {"partial", ParamType::boolean, "take partial runs as well", false, "false"}},
       .result = "EC0Y_urad, u_EC0Y_urad (combined), U_EC0Y_urad (k for 95 %), form_urad "
                 "(residual straightness of both axes) and both slopes, at "
                 "the fixture; notices",
       .example = R"({"run_x": 1, "run_y": 2})",
       .writes = true,
       .handler = [&m](const Params& p, Reply r) { squareness(m, p, std::move(r)); }});
}

}  // namespace mdof::daemon
