#include "tools/mdof/commands/part/part_layers.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "algo/form/surface.h"
#include "algo/milling/milling.h"
#include "algo/part/machine_causes.h"
#include "drivers/csv/csv_table.h"
#include "schema/base/files.h"
#include "schema/base/number/number_text.h"
#include "schema/milling/milling_plan.h"
#include "schema/units.h"
#include "tools/mdof/commands/form/map_file.h"
#include "tools/mdof/commands/machine/machine_file.h"
#include "tools/mdof/output.h"
#include "tools/mdof/stored/database.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

using Field = std::vector<Eigen::Vector3d>;
constexpr std::size_t kMostPoints = 100'000;
constexpr double kMostPlace_mm = 1e6;  // 1 km: larger coordinates have another unit

// ---- the path ----

Result<algo::PartPath> load_path(const std::string& file) {
  MDOF_TRY(const auto csv, drivers::read_csv_table(file, {"x_mm", "y_mm", "z_mm"},
                                                   {"nx", "ny", "nz"}, kMostPoints));
  algo::PartPath path;
  const bool has_normals = !csv.columns[3].empty();
  for (std::size_t k = 4; k < 6; ++k)
    if (csv.columns[k].empty() == has_normals)
      return bad_input(csv.source +
                       ": one or two of the columns nx, ny, nz are missing; give all three "
                       "columns, or remove all three");
  if (csv.rows() < 2)
    return bad_input(csv.source + ": the path has fewer than two points; give two or more points");
  for (std::size_t k = 0; k < csv.rows(); ++k) {
    for (std::size_t i = 0; i < 3; ++i)
      if (!(std::abs(csv.columns[i][k]) <= kMostPlace_mm))
        return bad_input(csv.where(k) + "a coordinate of the path is " +
                         plain_number(csv.columns[i][k]) +
                         " mm; the limit is 1 km; give the coordinates in mm");
    path.at_m.emplace_back(from_mm(csv.columns[0][k]), from_mm(csv.columns[1][k]),
                           from_mm(csv.columns[2][k]));
    if (!has_normals) continue;
    const Eigen::Vector3d n(csv.columns[3][k], csv.columns[4][k], csv.columns[5][k]);
    if (!(n.norm() > 0.5 && n.norm() < 2))
      return bad_input(csv.where(k) + "the normal nx, ny, nz has the length " +
                       plain_number(n.norm()) + "; the length must be near 1 (0.5 to 2)");
    path.normal.push_back(n / n.norm());
  }
  return path;
}

// ---- axes and budget ----

// Adds the tables that the plan names, as if the machine file named them. The same checks and sign
// conventions apply.
Status add_named_tables(LoadedPart& part, const PartLayer& layer, const std::string& database) {
  if (layer.from.empty()) return {};
  Machine& machine = part.machine;
  MDOF_TRY(store::Store store, open_to_read(database));
  for (const std::string& from : layer.from) {
    const std::int64_t number = *table_number(from);
    MDOF_TRY(const CompensationTable table, store.table(number));
    const auto frame =
        std::find_if(machine.frames.begin(), machine.frames.end(), [&](const MachineFrame& f) {
          return f.kind == FrameKind::linear && f.id == std::string(1, letter(table.axis));
        });
    if (frame == machine.frames.end())
      return bad_input(from + ": this is a table of axis " + std::string(1, letter(table.axis)) +
                       ", but the chain " + machine.chain.text +
                       " does not contain this axis; give tables of axes of the chain");
    frame->tables.ids.push_back(number);
    if (!table.has_positioning() && table.slope_removed && !machine.squareness.any()) {
      part.tables_without_slope.push_back(from);
      warn(from +
           ": the straightness in this table has no slope (a line was subtracted), so the error of "
           "the part does not contain squareness; to include squareness, build the table with "
           "--keep-slope");
    }
  }
  return {};
}

// ---- form and milling ----

// The error by clamping. After the cut the part springs back by the elastic deformation, and the
// surface moves towards -z.
Result<algo::PartCause> form_cause(LoadedPart& part, const PartLayer& layer,
                                   const std::string& file, const std::string& database) {
  MDOF_TRY(const SurfaceMap map, load_map(file, {{}, database}));
  const algo::Surface surface(map, 1, algo::Extension::line);
  algo::PartCause cause = algo::new_cause("spring-back", part.path.at_m.size());
  std::size_t& off = part.points_off_form_map;
  for (std::size_t k = 0; k < part.path.at_m.size(); ++k) {
    algo::SurfacePoint at;
    if (!surface.at(part.path.at_m[k](0), part.path.at_m[k](1), 1, at)) {
      ++off;
      continue;
    }
    cause.value_m[k](2) = -at.z_m;
    cause.u_m[k](2) = layer.u_m.value_or(0);
  }
  if (off == part.path.at_m.size())
    return bad_input(file + ": the map covers no point of the path " + part.plan.path +
                     "; map and path must both use the coordinates of the part");
  if (off > 0)
    part.notices.push_back(notice(NoticeCode::map_lacks_points, layer.name,
                                  {{"lacking", off}, {"points", part.path.at_m.size()}}));
  return cause;
}

// For each point, the last point before it (step -1) or the first point after it (step 1) that is
// at another place in the XY plane; if there is none, the point itself.
std::vector<Eigen::Vector3d> neighbours(const std::vector<Eigen::Vector3d>& at_m, int step) {
  std::vector<Eigen::Vector3d> found = at_m;
  const auto n = static_cast<std::ptrdiff_t>(at_m.size());
  for (std::ptrdiff_t i = 1; i < n; ++i) {
    const auto k = static_cast<std::size_t>(step < 0 ? i : n - 1 - i);
    const std::size_t beside = step < 0 ? k - 1 : k + 1;
    const bool is_same = at_m[k].head<2>() == at_m[beside].head<2>();
    // Points at one place have the same neighbour.
    if (!is_same)
      found[k] = at_m[beside];
    else if (found[beside].head<2>() != at_m[beside].head<2>())
      found[k] = found[beside];
  }
  return found;
}

// Unit vectors from the wall to the tool in the XY plane, at each point of the path. They are the
// normals of the path file, if it contains normals. Otherwise they are perpendicular to the path:
// in a down cut with the spindle clockwise (M3), the tool is left of the edge of the wall. A point
// at which the path turns back has the direction after it.
Result<Field> wall_normals(const algo::PartPath& path, bool is_up) {
  const auto before = neighbours(path.at_m, -1), after = neighbours(path.at_m, 1);
  Field normals;
  for (std::size_t k = 0; k < path.at_m.size(); ++k) {
    Eigen::Vector3d way = after[k] - before[k];
    if (way.head<2>().isZero(0)) way = after[k] - path.at_m[k];
    Eigen::Vector3d normal(-way(1), way(0), 0);
    if (is_up) normal = -normal;
    if (!path.normal.empty()) normal = {path.normal[k](0), path.normal[k](1), 0};
    normals.push_back(normal.stableNormalized());  // a zero vector stays zero
  }
  if (path.normal.empty() && std::all_of(normals.begin(), normals.end(),
                                         [](const auto& normal) { return normal.isZero(0); }))
    return bad_input(
        "the path does not move in the XY plane, so the side of the milled wall is unknown; add "
        "the "
        "columns nx,ny,nz to the path");
  return normals;
}

double sum_of_u(const algo::PartCause& cause) {
  double sum = 0;
  for (const Eigen::Vector3d& u : cause.u_m) sum += u.norm();
  return sum;
}

Result<std::vector<algo::PartCause>> milling_causes(LoadedPart& part, const std::string& file) {
  MDOF_TRY(const std::string text, read_text_file(file));
  MDOF_TRY(const DeclaredMillingPlan declared, parse_milling_plan(text, file));
  MDOF_TRY(const algo::MillingResult result, algo::milling(declared.plan));
  MDOF_TRY(const algo::WearOffset offset, algo::wear_offset(declared));
  MDOF_TRY(const Field normals, wall_normals(part.path, declared.plan.is_up));
  std::vector<algo::PartCause> causes = {
      algo::new_cause("tool deflection", part.path.at_m.size()),
      algo::new_cause("deflection over the depth", part.path.at_m.size())};
  for (std::size_t k = 0; k < normals.size(); ++k) {
    // A positive offset is directed into the wall, against the normal.
    causes[0].value_m[k] = -result.wall.offset_mean_m * normals[k];
    if (std::isfinite(offset.u_m)) causes[0].u_m[k] = offset.u_m * normals[k];
    // The wall has a slope over the depth of cut. Its standard deviation is form / sqrt(12).
    causes[1].u_m[k] = result.wall.form_m / std::sqrt(12.0) * normals[k];
  }
  if (sum_of_u(causes[0]) == 0) {
    part.no_u.push_back(causes[0].name);
    return causes;
  }
  for (const MillingInput* input : offset.not_declared) part.no_u.push_back(input->name());
  return causes;
}

// ---- all layers ----

// A cause after its compensation: the value is 0, the uncertainty remains.
algo::PartCause without_value(algo::PartCause cause) {
  for (Eigen::Vector3d& value : cause.value_m) value.setZero();
  return cause;
}

void add_layer(LoadedPart& part, const PartLayer& plan, const std::string& compensated_by,
               const std::vector<algo::PartCause>& causes) {
  const std::size_t number = part.layers.size();
  part.layers.push_back({plan, compensated_by});
  for (algo::PartCause cause : causes) {
    cause.layer = number;
    part.left.push_back(without_value(cause));
    part.causes.push_back(plan.compensated ? part.left.back() : cause);
  }
}

Status add_machine_layers(LoadedPart& part) {
  const PartLayer *axes = nullptr, *budget = nullptr;
  for (const PartLayer& layer : part.plan.layers) {
    if (layer.on && layer.name == "axes") axes = &layer;
    if (layer.on && layer.name == "budget") budget = &layer;
  }
  if (!axes && !budget) return {};
  const algo::MachineCauses found =
      algo::machine_causes(part.machine, part.path.at_m, axes != nullptr);
  if (axes && found.axes.empty())
    return bad_input(part.plan.machine +
                     ": the layer \"axes\" needs measured errors, but the machine file has no "
                     "measured errors; add measured errors to the machine file, or give tables of "
                     "the axes in the part file: axes = \"table:N\"");
  if (budget && found.budget.empty())
    return bad_input(part.plan.machine +
                     ": the layer \"budget\" needs one or more [[source]] tables, but the machine "
                     "file has none; add [[source]], or remove this layer from the part file");
  part.not_measured = found.not_measured;
  part.beyond_tables = found.beyond;
  warn_outside_tables(found.beyond);
  if (axes) {
    add_layer(part, *axes, "compensating command (mdof machine error, mdof compensation export)",
              found.axes);
    part.no_u = found.no_u;
    part.unknown_approach = found.unknown_approach;
  }
  if (budget) {
    if (budget->compensated)
      return bad_input(
          part.plan.machine +
          ": the layer \"budget\" cannot be compensated, because the sources of this layer were "
          "not measured; remove \"compensated\" from this layer in the part file");
    add_layer(part, *budget, "", found.budget);
  }
  return {};
}

}  // namespace

Result<LoadedPart> load_part(const std::string& file, const std::string& database) {
  LoadedPart part;
  MDOF_TRY(const std::string text, read_text_file(file));
  MDOF_TRY(part.plan, parse_part_plan(text, file));
  const auto folder = std::filesystem::path(file).parent_path();
  const auto beside = [&folder](const std::string& name) { return (folder / name).string(); };
  MDOF_TRY(part.machine, described_machine(beside(part.plan.machine)));
  for (const PartLayer& layer : part.plan.layers)
    if (layer.name == "axes") MDOF_CHECK(add_named_tables(part, layer, database));
  MDOF_CHECK(add_stored_errors(part.machine, database));
  MDOF_TRY(part.path, load_path(beside(part.plan.path)));
  MDOF_CHECK(add_machine_layers(part));
  for (const PartLayer& layer : part.plan.layers) {
    if (!layer.on) continue;
    if (layer.name == "form") {
      const std::string& from = layer.from.front();
      const bool of_run = from.starts_with("run:");
      MDOF_TRY(const auto cause, form_cause(part, layer, of_run ? from : beside(from), database));
      add_layer(part, layer, "path of a fast tool servo (mdof form path)", {cause});
      if (!layer.u_m) part.no_u.push_back("form");
    }
    if (layer.name == "milling") {
      MDOF_TRY(const auto causes, milling_causes(part, beside(layer.from.front())));
      add_layer(part, layer, "radius wear offset (mdof milling --offset)", causes);
    }
  }
  return part;
}

}  // namespace mdof::tools
