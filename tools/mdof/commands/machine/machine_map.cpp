// mdof machine map MACHINE.toml --plane XY --step-mm S: calculates the errors of the tool over a
// plane.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "algo/machine/plane_map.h"
#include "daemon/output/charts/machine/plane_map_chart.h"
#include "daemon/output/charts/plot_files.h"
#include "schema/base/number/number.h"
#include "schema/units.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/commands/machine/machine_file.h"
#include "tools/mdof/csv/csv_text.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/run_tables.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

struct MachineMapCommand {
  std::string file, database, plane = "XY", at = "", approach = "mean", plots;
  double step_mm = 10;
  bool without_angles = false, bidirectional = false, csv = false, json = false;
};

struct FoundMap {
  std::string approach;
  algo::PlaneMap map;
};

std::string key_in_mm(std::size_t direction) {
  return std::string(1, "XYZ"[direction]) + "_mm";
}

std::string csv_header(const Machine& machine, const std::vector<FoundMap>& maps) {
  CsvText csv;
  const auto& first = maps.front().map;
  if (maps.size() > 1) csv.cell("approach");
  csv.cells({key_in_mm(first.first), key_in_mm(first.second)});
  for (int k = 0; k < 3; ++k) csv.cell(kComponents[k]);
  for (int k = 0; k < 3; ++k) csv.cell(std::string("u_") + kComponents[k]);
  csv.end_row();
  return noise_only_comment(noise_only(machine)) + "# u is the standard uncertainty. It contains " +
         covers_text(machine, !first.no_u.empty()) + ".\n" + csv.take();
}

// Writes the same text as CsvText, but faster, because a map may have a million rows. It converts
// many numbers at a time, and each position of an axis only once.
class MapRows {
 public:
  MapRows(const FoundMap& found, bool with_approach)
      : map_(found.map),
        begins_(map_.first_m.size()),
        values_(kValues * map_.first_m.size()),
        texts_(values_.size()),
        line_(map_.first_m.size() * (2 * sizeof(Cell) + kValues * (kDouble17Size + 1) + 1)) {
    const std::string approach = with_approach ? found.approach + ',' : "";
    for (std::size_t i = 0; i < begins_.size(); ++i)
      begins_[i] = Cell(approach + in_mm_17(map_.first_m[i]));
  }

  // The text of all rows at one position of the second axis. It is valid until the next call.
  std::string_view line(std::size_t j) {
    const std::size_t n = begins_.size();
    for (std::size_t i = 0; i < n; ++i) {
      const algo::PlanePoint& p = map_.points[j * n + i];
      for (std::size_t k = 0; k < 3; ++k) {
        const auto of = static_cast<Eigen::Index>(k);
        values_[kValues * i + k] = to_um(p.error[of]) + 0.0;  // converts -0 to 0
        values_[kValues * i + 3 + k] = to_um(p.u[of]);
      }
    }
    write_doubles_17(values_.data(), values_.size(), texts_.data());
    const Cell second_mm(',' + in_mm_17(map_.second_m[j]));
    char* out = line_.data();
    for (std::size_t i = 0; i < n; ++i) {
      out = second_mm.copy_to(begins_[i].copy_to(out));
      for (std::size_t k = kValues * i; k < kValues * (i + 1); ++k) {
        *out++ = ',';
        if (!std::isfinite(values_[k])) continue;
        std::memcpy(out, texts_[k].text, kDouble17Size);  // copying a fixed size is faster
        out += texts_[k].size;
      }
      *out++ = '\n';
    }
    return {line_.data(), static_cast<std::size_t>(out - line_.data())};
  }

 private:
  static constexpr std::size_t kValues = 6;
  // The text of the approach and of one position, at most 33 characters. The whole buffer is
  // copied, because copying a fixed size is faster.
  struct Cell {
    Cell() = default;
    explicit Cell(const std::string& of) : size(std::min(of.size(), text.size())) {
      std::copy_n(of.begin(), size, text.begin());
    }
    char* copy_to(char* out) const {
      std::memcpy(out, text.data(), text.size());
      return out + size;
    }
    std::array<char, 48> text{};
    std::size_t size = 0;
  };
  static std::string in_mm_17(double at_m) { return CsvText().cell(to_mm(at_m)).take(); }

  const algo::PlaneMap& map_;
  std::vector<Cell> begins_;
  std::vector<double> values_;  // values of one line
  std::vector<DoubleText> texts_;
  std::vector<char> line_;
};

Status write_csv(const Machine& machine, const std::vector<FoundMap>& maps) {
  MDOF_CHECK(write_out(csv_header(machine, maps)));
  for (const FoundMap& found : maps) {
    MapRows rows(found, maps.size() > 1);
    for (std::size_t j = 0; j < found.map.second_m.size(); ++j)
      MDOF_CHECK(write_commands(rows.line(j)));
  }
  return {};
}

void write_extremes(JsonWriter& json, const algo::PlaneMap& map) {
  json.key("largest").begin_object();
  for (std::size_t k = 0; k < 3; ++k) {
    const algo::MapExtreme& extreme = map.extremes[k];
    json.key(kComponents[k])
        .begin_object()
        .field("value_um", to_um(extreme.value))
        .field("u_um", to_um(extreme.u))
        .field("range_um", to_um(extreme.range))
        .field(key_in_mm(map.first), to_mm(map.first_at(extreme.point)))
        .field(key_in_mm(map.second), to_mm(map.second_at(extreme.point)))
        .end_object();
  }
  json.end_object();
}

void write_grid(JsonWriter& json, const algo::PlaneMap& map) {
  json.key("points").begin_array();
  for (std::size_t row = 0; row < map.points.size(); ++row) {
    const algo::PlanePoint& p = map.points[row];
    json.begin_object()
        .field(key_in_mm(map.first), to_mm(map.first_at(row)))
        .field(key_in_mm(map.second), to_mm(map.second_at(row)));
    for (int k = 0; k < 3; ++k) json.field(kComponents[k], to_um(p.error[k]));
    for (int k = 0; k < 3; ++k) json.field(std::string("u_") + kComponents[k], to_um(p.u[k]));
    json.end_object();
  }
  json.end_array();
}

std::string map_json(const Machine& machine, const MachineMapCommand& o,
                     const std::vector<FoundMap>& maps) {
  JsonWriter json;
  json.begin_object()
      .field("machine", machine.name)
      .field("chain", machine.chain.text)
      .field("simulated", machine.simulated)
      .field("noise_only", noise_only(machine) == NoiseOnly::all)
      .field("u_covers", covers_text(machine, !maps.front().map.no_u.empty()))
      .field("plane", o.plane)
      .field("without_angles", o.without_angles)
      .key("maps")
      .begin_array();
  for (const FoundMap& found : maps) {
    json.begin_object().field("approach", found.approach);
    write_extremes(json, found.map);
    write_strings(json, "not_measured", found.map.not_measured);
    write_strings(json, "not_declared", found.map.no_u);
    write_strings(json, "beyond_tables", found.map.beyond);
    write_grid(json, found.map);
    json.end_object();
  }
  json.end_array();
  write_stored_notices(json, machine);
  json.end_object();
  return json.take();
}

std::string map_text(const Machine& machine, const MachineMapCommand& o,
                     const std::vector<FoundMap>& maps) {
  const auto& first = maps.front().map;
  TextTable table(
      {"approach", "", "largest/µm", "u/µm", "at " + std::string(1, "XYZ"[first.first]) + "/mm",
       std::string(1, "XYZ"[first.second]) + "/mm", "range/µm"},
      2);
  for (const FoundMap& found : maps) {
    for (std::size_t k = 0; k < 3; ++k) {
      const algo::MapExtreme& extreme = found.map.extremes[k];
      table.add({found.approach, std::string(1, "xyz"[k]), um_to_place(extreme.value, extreme.u),
                 um_to_place(extreme.u, extreme.u), in_mm(found.map.first_at(extreme.point)),
                 in_mm(found.map.second_at(extreme.point)), in_um(extreme.range)});
    }
  }
  return noise_only_notice(noise_only(machine)) + simulated_notice(machine.simulated) +
         wrapped(machine.name + ", " + machine.chain.text + ": " +
                     std::to_string(first.first_m.size() * first.second_m.size()) +
                     " points of the plane " + o.plane +
                     ", error of the tool relative to the workpiece",
                 terminal_columns()) +
         "\n" + table.text(terminal_columns()) +
         (o.without_angles ? "the values contain positioning, straightness and squareness, but no "
                             "angular errors\n"
                           : "") +
         wrapped("u is the standard uncertainty. It contains " +
                     covers_text(machine, !first.no_u.empty()) + ".",
                 terminal_columns()) +
         "\n" + missing_text(first.not_measured, first.no_u, terminal_columns()) +
         "--csv and --json print all points\n";
}

Status draw_maps(const Machine& machine, const MachineMapCommand& o,
                 const std::vector<FoundMap>& maps) {
  if (o.plots.empty()) return {};
  std::vector<charts::NamedChart> drawn;
  for (const FoundMap& found : maps) {
    const std::size_t points = found.map.points.size();
    if (points > charts::kMostArrows)
      return fail(ErrorCode::usage, "--plot: " + std::to_string(points) +
                                        " points are too many for a chart (at most " +
                                        std::to_string(charts::kMostArrows) +
                                        "); give a larger --step-mm");
    drawn.push_back(
        {"map-" + o.plane + "-" + found.approach + ".svg",
         charts::plane_map_svg(
             found.map, {machine.name, found.approach, machine.simulated, noise_only(machine)},
             words::Language::english)});
  }
  return write_plots(drawn, o.plots);
}

Status machine_map(const MachineMapCommand& o) {
  if (!(o.step_mm > 0 && std::isfinite(o.step_mm)))
    return fail(ErrorCode::usage, "--step-mm must be a finite number above 0");
  MDOF_TRY(const Machine machine, load_machine(o.file, o.database));
  algo::PlaneMapRequest request;
  request.first = std::string("XYZ").find(o.plane[0]);
  request.second = std::string("XYZ").find(o.plane[1]);
  request.step_m = from_mm(o.step_mm);
  request.without_angles = o.without_angles;
  request.extremes_only = !o.csv && !o.json && o.plots.empty();
  if (!o.at.empty()) {
    MDOF_TRY(request.others, command_from(machine, o.at));
  }
  std::vector<FoundMap> maps;
  for (const char* approach : {"forward", "reverse"}) {
    const std::string name = o.bidirectional ? approach : o.approach;
    request.approach = approach_from(name);
    MDOF_TRY(auto map, algo::plane_map(machine, request));
    maps.push_back({name, std::move(map)});
    if (!o.bidirectional) break;
  }
  warn_outside_tables(maps.front().map.beyond);
  MDOF_CHECK(draw_maps(machine, o, maps));
  if (o.csv || o.json) {
    if (o.csv && !maps.front().map.not_measured.empty())
      warn("these errors were not measured, so the values do not contain them: " +
           joined(maps.front().map.not_measured));
    return o.csv ? write_csv(machine, maps) : write_line(map_json(machine, o, maps));
  }
  return write_out(map_text(machine, o, maps));
}

Action declare_machine_map(CLI::App& command) {
  const auto o = std::make_shared<MachineMapCommand>();
  add_machine_argument(command, o->file);
  command.add_option("--plane", o->plane, "The two axes of the plane")
      ->check(CLI::IsMember({"XY", "XZ", "YZ"}))
      ->capture_default_str();
  command.add_option("--step-mm", o->step_mm, "Approximate distance between two points")
      ->capture_default_str();
  command
      .add_option("--at", o->at,
                  "Positions of the axes that are not in the plane, such as Z=30 [default: 0]")
      ->type_name("AXIS=MM");
  add_approach_option(command, o->approach);
  command
      .add_flag("--bidirectional", o->bidirectional,
                "Calculate one map for each of the two approaches")
      ->excludes("--approach");
  command.add_flag("--without-angles", o->without_angles,
                   "Use only positioning, straightness and squareness; leave out angular errors");
  add_database_option(command, o->database);
  add_plot_option(command, o->plots);
  add_csv_and_json_flags(command, o->csv, o->json);
  return [o] { return machine_map(*o); };
}

}  // namespace

Command machine_map_command() {
  return {.name = "machine map",
          .summary = "Calculate the errors of the tool over a plane, and the largest errors",
          .footer = "Example:\n  mdof machine map machine.toml --plane XY --step-mm 20 --csv",
          .declare = declare_machine_map};
}

}  // namespace mdof::tools
