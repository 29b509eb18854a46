#include "tools/mdof/text/plausibility_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "schema/units.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

constexpr std::size_t kColumns = 80;
// Largest number of rows: targets with unusual numbers of visits.
constexpr std::size_t kMostRows = 20;
constexpr std::size_t kMostStops = 10;  // largest number of listed rejected stops
// Up to this number of passes, the counts of all passes are written side by side.
constexpr std::size_t kRunsAsDigits = 20;

std::string number(const char* format, double x) {
  if (!std::isfinite(x)) return "-";
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), format, x);
  return text.data();
}

std::string times(int n) {
  return n == 1 ? "once" : std::to_string(n) + " times";
}

int sum(const std::vector<int>& counts) {
  int total = 0;
  for (const int n : counts) total += n;
  return total;
}

// The number of visits in each pass, such as "1 1 0", or the sum if there are many passes.
std::string by_run(const std::vector<int>& counts) {
  if (counts.size() > kRunsAsDigits) return std::to_string(sum(counts));
  std::string out;
  for (const int n : counts) out += (out.empty() ? "" : " ") + std::to_string(n);
  return out;
}

using Counts = std::pair<std::vector<int>, std::vector<int>>;

// The numbers of visits that most targets have.
Counts usual(const std::vector<TargetVisits>& n_ij) {
  std::vector<Counts> all;
  for (const auto& row : n_ij) all.emplace_back(row.forward, row.reverse);
  std::sort(all.begin(), all.end());
  Counts best;
  std::ptrdiff_t most = 0;
  for (auto i = all.begin(); i != all.end();) {
    const auto end = std::upper_bound(i, all.end(), *i);
    if (end - i > most) best = *i, most = end - i;
    i = end;
  }
  return best;
}

std::string targets_text(const Plausibility& p) {
  std::string out = "targets    " + std::to_string(p.n_ij.size()) + " found";
  if (p.n_ij.empty()) return out + "\n";
  const Counts most = usual(p.n_ij);
  TextTable table({"target", "position/mm", "forward, by run", "reverse, by run"});
  std::size_t odd = 0;
  for (std::size_t i = 0; i < p.n_ij.size(); ++i) {
    const auto& row = p.n_ij[i];
    if (Counts{row.forward, row.reverse} == most || ++odd > kMostRows) continue;
    table.add(
        {std::to_string(i + 1), in_mm(row.target_m), by_run(row.forward), by_run(row.reverse)});
  }
  out += ", " + std::string(odd == 0 ? "each" : "most") + " measured " + times(sum(most.first)) +
         " forward, " + times(sum(most.second)) + " in reverse\n";
  if (odd == 0) return out;
  out += "visits     " + std::to_string(odd) +
         (odd == 1 ? " target has another number of visits:\n"
                   : " targets have another number of visits:\n") +
         table.text();
  if (odd > kMostRows) out += "... and " + std::to_string(odd - kMostRows) + " more, see --json\n";
  return out;
}

std::string left_out_text(const Plausibility& p) {
  std::string out;
  for (std::size_t i = 0; i < std::min(p.left_out.size(), kMostStops); ++i) {
    const auto& stop = p.left_out[i];
    const std::string line = "left out   " + in_mm(stop.position_m) + " mm: " + stop.reason;
    out += (line.size() <= kColumns
                ? line
                : "left out   " + in_mm(stop.position_m) + " mm:\n           " + stop.reason) +
           "\n";
  }
  if (p.left_out.size() > kMostStops)
    out += "           and " + std::to_string(p.left_out.size() - kMostStops) + " more stops\n";
  return out;
}

std::string probes_text(const std::vector<ProbeFigures>& probes) {
  TextTable table({"probe", "points", "sd/µm", "travel/µm", "min/µm", "max/µm"});
  for (const ProbeFigures& p : probes)
    table.add({p.id, std::to_string(p.points), in_um(p.sd_m), in_um(p.travel_m), in_um(p.min_m),
               in_um(p.max_m)});
  return table.text();
}

}  // namespace

std::string plausibility_text(const Plausibility& p) {
  std::string out = "plausibility\n";
  out += "cycle      " + p.cycle + ", " + std::to_string(p.runs) +
         (p.runs == 1 ? " run" : " runs") + "\n";
  out += "encoder    " + in_mm(p.encoder_min_m) + " to " + in_mm(p.encoder_max_m) + " mm, " +
         number("%.4g Hz", p.rate_hz) + "\n";
  out += "samples    " + std::to_string(p.scans) + " scans, " +
         (p.scans_lost > 0 ? std::to_string(p.scans_lost) + " lost, " : "") +
         std::to_string(p.gaps) + (p.gaps == 1 ? " gap" : " gaps") +
         (std::isfinite(p.duration_s) ? ", " + number("%.1f s\n", p.duration_s) : "\n");
  out += targets_text(p) + left_out_text(p);
  if (p.short_stops > 0)
    out += "no point   " + std::to_string(p.short_stops) +
           (p.short_stops == 1 ? " stop" : " stops") +
           " at targets gave no point (too short, or the axis moved slowly)\n";
  return out + probes_text(p.probes);
}

}  // namespace mdof::tools
