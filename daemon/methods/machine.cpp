// The method machine.at.
#include "algo/machine/budget/budget.h"
#include "daemon/measure/machine/machine_files.h"
#include "daemon/measure/machine/stored_errors.h"
#include "daemon/measure/machine/table_functions.h"
#include "daemon/methods/methods.h"
#include "daemon/words/words.h"
#include "schema/base/json_writer.h"
#include "schema/run_json.h"
#include "schema/units.h"

namespace mdof::daemon {
namespace {

using rpc::Params;
using rpc::ParamType;

constexpr std::string_view kLetters = "XYZABC";
constexpr const char* kComponents[] = {"x_um", "y_um", "z_um", "a_urad", "b_urad", "c_urad"};

// Rejects a machine file that refers to other files. Clients call this method for each commanded
// position, so the method reads no files.
Status check_no_files(const Machine& machine) {
  if (!has_table_files(machine)) return {};
  return bad_input(
      "the machine file refers to other files, but machine.at does not read files; write the "
      "tables into the machine file (EXX_um = [[…]]), or refer to runs and tables of the database");
}

void write_error(JsonWriter& json, const char* key, const algo::Vector6& error) {
  json.key(key).begin_object();
  for (int k = 0; k < 6; ++k) json.field(kComponents[k], to_key_unit(error[k]));
  json.end_object();
}

Result<std::string> error_at(const Machine& machine, const algo::Command& at) {
  const auto mean = algo::MachineApproach::mean;
  const algo::ToolError error = algo::tool_error(machine, at, mean);
  MDOF_TRY(const auto model, algo::budget_model(machine, at, mean, algo::BudgetStage::measured));
  const Eigen::Vector3d u = algo::budget_u_m(model);
  JsonWriter json;
  json.begin_object().field("machine", machine.name).field("simulated", machine.simulated);
  write_error(json, "error", error.exact);
  json.key("u").begin_object();
  // u is 0 if no error with a known u, and no other source of uncertainty, affects the component.
  for (int k = 0; k < 3; ++k) json.field(kComponents[k], u[k] > 0 ? to_um(u[k]) : kNaN);
  json.end_object();
  if (!(u.minCoeff() > 0))
    json.field("u_reason",
               "u is null (unknown) for each component on which no known uncertainty acts");
  std::vector<std::string> missing, no_u;
  for (const auto& names : error.not_measured) algo::add_new(names, missing);
  for (const auto& names : error.no_u) algo::add_new(names, no_u);
  write_strings(json, "not_measured", missing);
  write_strings(json, "not_declared", no_u);
  json.field("u_covers", covers_text(machine, !no_u.empty(), true))
      .field("noise_only", noise_only(machine, true) == NoiseOnly::all);
  write_strings(json, "beyond_tables", error.beyond);
  json.end_object();
  return json.take();
}

Result<QueryThread::Work> machine_at(Methods&, const Params& params) {
  MDOF_TRY(const Machine machine, machine_param(params));
  MDOF_CHECK(check_no_files(machine));
  MDOF_TRY(const algo::Command at, command_of(params, machine));
  return [machine, at](store::Store& store) -> Result<std::string> {
    Machine measured = machine;
    MDOF_TRY(const StoredErrors stored, read_stored_errors(store, measured));
    MDOF_TRY(std::string json, error_at(measured, at));
    return with_notices(std::move(json), all_notices(stored), words::text);
  };
}

}  // namespace

std::string machine_source(const Params& params) {
  return std::string(params.string("machine_source", "machine"));
}

Result<Machine> machine_param(const Params& params) {
  MDOF_TRY(Machine machine, parse_machine(params.string("machine"), machine_source(params)));
  add_curvatures(machine);
  return machine;
}

std::vector<rpc::Param> machine_params() {
  return {{"machine",
           ParamType::string,
           "machine file (MACHINE.toml) as text",
           true,
           {},
           {.bytes = 60'000}},
          {"machine_source", ParamType::string,
           "file name of the machine file, used in messages. If the machine file refers to other "
           "files, give the absolute path of the machine file: mdofd reads the other files from "
           "the same folder",
           false}};
}

Result<algo::Command> command_of(const Params& params, const Machine& machine) {
  algo::Command command{};
  for (std::size_t i = 0; i < kLetters.size(); ++i) {
    const std::string letter(1, kLetters[i]), key = letter + (i < 3 ? "_mm" : "_deg");
    if (!params.has(key)) continue;
    const MachineFrame* frame = machine.find(letter);
    if (!frame)
      return fail(ErrorCode::usage,
                  key + ": the chain " + machine.chain.text + " has no axis " + letter);
    command[i] = position_from_written(*frame, params.number(key));
  }
  return command;
}

std::vector<rpc::Param> command_params(const char* what) {
  const rpc::Bounds mm{.least = -1e6, .most = 1e6};
  std::vector<rpc::Param> params;
  for (std::size_t i = 0; i < kLetters.size(); ++i)
    params.push_back({std::string(1, kLetters[i]) + (i < 3 ? "_mm" : "_deg"), ParamType::number,
                      what, false, "0", mm});
  return params;
}

void add_machine_methods(rpc::MethodTable& table, Methods& m) {
  std::vector<rpc::Param> params = machine_params();
  for (rpc::Param& each : command_params("commanded position of the axis"))
    params.push_back(std::move(each));
  table.add({.name = "machine.at",
             .summary = "Calculates the error of the tool relative to the workpiece at a commanded "
                        "position of a machine, with u. Nothing is stored.",
             .params = params,
             .members =
                 "{machine!, simulated, error: tool_error, u: {{small}_um: number}, u_reason?, "
                 "not_measured, not_declared, u_covers, noise_only, beyond_tables, ...notices}",
             .example = R"({"machine": "name = \"m\"\nmachine = {chain = \"w-b-X-t\"}\n)"
                        R"([[axis]]\nid = \"X\"\nholds_at_mm = [0, 0, 0]\npoint = \"moving\"\n)"
                        R"(EXX_um = 2\nu_EXX_um = 0.1\n", "X_mm": 10})",
             .handler = on_query(m, machine_at)});
}

}  // namespace mdof::daemon
