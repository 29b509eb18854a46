#include "daemon/output/charts/machine/table_maps.h"

#include <array>
#include <tuple>
#include <utility>

#include "daemon/output/charts/labels.h"
#include "daemon/output/charts/machine/plane_map_chart.h"
#include "schema/units.h"

namespace mdof::charts {
namespace {

algo::PlaneMap plane_through_middle(const VolumetricTable& table, std::size_t first,
                                    std::size_t second) {
  algo::PlaneMap map;
  map.first = first;
  map.second = second;
  map.first_m = table.command_m[first];
  map.second_m = table.command_m[second];
  std::array<std::size_t, 3> at;
  for (std::size_t axis = 0; axis < at.size(); ++axis) at[axis] = table.command_m[axis].size() / 2;
  for (at[second] = 0; at[second] < map.second_m.size(); ++at[second])
    for (at[first] = 0; at[first] < map.first_m.size(); ++at[first]) {
      const std::size_t node = table.node(at[0], at[1], at[2]);
      algo::PlanePoint point;
      for (std::size_t axis = 0; axis < at.size(); ++axis) {
        const auto row = static_cast<Eigen::Index>(axis);
        point.error[row] = table.correction_m[node][axis];
        point.u[row] = table.u_m[node][axis];
      }
      map.points.push_back(point);
    }
  map.not_measured = table.not_measured;
  map.no_u = table.u_not_declared;
  map.beyond = table.beyond_tables;
  return map;
}

}  // namespace

RunCharts volumetric_table_charts(const VolumetricTable& table, output::Language language) {
  RunCharts all;
  const std::string name = "table-" + std::to_string(table.id);
  for (const auto& [first, second] : {std::pair{0, 1}, {0, 2}, {1, 2}}) {
    const std::size_t third = static_cast<std::size_t>(3 - first - second);
    const auto& [a, b] = std::tie(table.command_m[static_cast<std::size_t>(first)],
                                  table.command_m[static_cast<std::size_t>(second)]);
    if (a.size() < 2 || b.size() < 2) continue;
    const std::string plane = {"XYZ"[first], "XYZ"[second]};
    if (a.size() * b.size() > kMostArrows) {
      all.left_out.push_back("table " + std::to_string(table.id) + ", plane " + plane + ": " +
                             count_text(a.size() * b.size()) +
                             " nodes are too many for a chart (at most " + count_text(kMostArrows) +
                             ")");
      continue;
    }
    const std::vector<double>& others = table.command_m[third];
    MapPicture picture{table.name, table.approach, table.simulated, table.noise_only};
    picture.table = table.id;
    if (!others.empty())
      picture.place = std::string{"XYZ"[third]} + " = " +
                      number_text(to_mm(others[others.size() / 2]), 6) + " mm";
    all.charts.push_back({name + "-" + plane + ".svg",
                          plane_map_svg(plane_through_middle(table, static_cast<std::size_t>(first),
                                                             static_cast<std::size_t>(second)),
                                        picture, language)});
  }
  return all;
}

}  // namespace mdof::charts
