#include "tools/mdof/run_tables.h"

#include <array>
#include <cmath>
#include <cstdio>

#include "schema/axis.h"
#include "tools/mdof/text_table.h"

namespace mdof::tools {

std::string simulated_notice(bool simulated) {
  return simulated ? "SIMULATED DATA: no machine was measured.\n" : "";
}

std::string arrow(int direction) {
  return direction > 0 ? "+" : direction < 0 ? "-" : "?";
}

std::string error_label(const std::string& key) {
  const auto at = key.find('_');
  const std::string name = key.substr(0, at), unit = key.substr(at + 1);
  return name + "/" + (unit == "um" ? "µm" : "µrad");
}

std::string stated_text(const StatedAt& at) {
  switch (at.reference) {
    case Reference::carriage:
      return "straightness of the carriage's origin, which travels with the target (Eq. 2-12)\n";
    case Reference::tool: {
      std::string text = "straightness at the tool point of the fixture,";
      for (const double x : at.point_m) text += " " + in_mm(x);
      return text + " mm\n";
    }
    case Reference::fixture:
      break;
  }
  return "straightness at the fixture\n";
}

namespace {

std::string temperature_text(const Temperature& read) {
  std::array<char, 80> text{};
  std::snprintf(text.data(), text.size(), "%.2f °C (%.2f to %.2f)", read.mean_C, read.min_C,
                read.max_C);
  return text.data();
}

}  // namespace

std::string head_text(const RunHeader& h) {
  const auto& from = h.provenance;
  std::string out = simulated_notice(h.simulated);
  out += "run " + (h.id == 0 ? std::string("(not stored)") : std::to_string(h.id)) + ", axis " +
         letter(h.axis) + ", " + to_string(h.state) + ", model " + from.model + ", " +
         h.started_utc + "\n";
  if (!h.note.empty()) out += "note       " + h.note + "\n";
  if (h.supersedes) out += "supersedes run " + std::to_string(*h.supersedes) + "\n";
  out += from.recording_kind + "  " + from.recording_path + "\n";
  out += "scans      " + std::to_string(h.scans) + ", lost " + std::to_string(h.scans_lost) + "\n";
  if (h.temperature) out += "at         " + temperature_text(*h.temperature) + "\n";
  out += "software   " + from.software_version + "\n";
  for (const auto& warning : h.warnings) out += "warning    " + warning + "\n";
  return out;
}

std::string points_text(const Run& run) {
  const Axis axis = run.header.axis;
  std::vector<std::string> head{"target", "run", "dir", "position/mm"};
  for (const auto& name : error_names(axis)) head.push_back(error_label(name.key));
  head.insert(head.end(), {"samples", "flags"});
  TextTable table(std::move(head));
  for (const MeasuredPoint& p : run.points) {
    std::vector<std::string> row{std::to_string(p.target), std::to_string(p.run),
                                 arrow(p.point.direction), in_mm(p.point.position_m)};
    const Errors5 named = named_from_local(run.header.moving(), p.errors.local);
    const Covariance5 cov = named_from_local(axis, p.errors.covariance);
    for (std::size_t k = 0; k < 5; ++k) {
      const auto show = error_names(axis)[k].angle ? in_urad : in_um;
      row.push_back(p.errors.valid ? with_u(show(named[k]), show(std::sqrt(cov[6 * k]))) : "-");
    }
    const std::string why = p.errors.valid ? "" : "unsolved: " + p.errors.reason;
    std::string flags = joined(p.point.flags, " ");
    flags += (flags.empty() || why.empty() ? "" : " ") + why;
    row.insert(row.end(), {std::to_string(p.point.samples), flags});
    table.add(std::move(row));
  }
  return table.text() + "± one standard uncertainty; error = actual - nominal, of the " +
         run.header.sides.moves() + "\n" + stated_text(run.header.stated);
}

std::string straightness_text(const std::vector<StraightnessFigure>& figures) {
  TextTable table({"error", "approach", "least squares/µm", "end points/µm", "slope/µrad",
                   "end slope/µrad", "peak at/mm", "valley at/mm"});
  for (const auto& f : figures) {
    table.add({f.error_key.substr(0, 3), f.approach, in_um(f.straightness_least_squares_m),
               in_um(f.straightness_end_point_m),
               with_u(in_urad(f.slope_least_squares_rad), in_urad(f.u_slope_least_squares_rad)),
               in_urad(f.slope_end_point_rad), in_mm(f.peak_position_m),
               in_mm(f.valley_position_m)});
  }
  return "straightness, peak to valley about each reference line\n" + table.text();
}

std::string angles_text(const std::vector<AngleFigure>& figures) {
  TextTable table({"error", "approach", "at start/µrad", "min/µrad", "max/µrad", "range/µrad"});
  for (const auto& f : figures) {
    table.add({f.error_key.substr(0, 3), f.approach, in_urad(f.start_rad), in_urad(f.min_rad),
               in_urad(f.max_rad), in_urad(f.max_rad - f.min_rad)});
  }
  return "angles, referred to the first target\n" + table.text();
}

}  // namespace mdof::tools
