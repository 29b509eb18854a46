#include "tools/mdof/text/analyses/separation_text.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "schema/base/number/number_text.h"
#include "schema/separation/separation_json.h"
#include "schema/units.h"
#include "tools/mdof/csv/csv_text.h"
#include "tools/mdof/text/run_tables.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

constexpr int kDigits = 9;  // significant digits of heights in a map

std::string along(const SeparationRecord& record) {
  return std::string("+") + letter(record.normal);
}

std::string turned_text(const SeparationSource& source) {
  if (source.end_for_end)
    return source.height_sign < 0 ? "turned end for end, faces the opposite side"
                                  : "turned end for end";
  return source.height_sign < 0 ? "faces the opposite side" : "as in set-up 1";
}

std::string sources_text(const SeparationRecord& record, std::size_t width) {
  TextTable table({"set-up", "source", "target", "target zero at/mm"});
  for (std::size_t k = 0; k < record.sources.size(); ++k) {
    const SeparationSource& s = record.sources[k];
    table.add({std::to_string(k + 1), s.name, turned_text(s), in_mm(s.shift_m)});
  }
  return table.text(width);
}

std::string series_text(const std::string& title, const std::string& place,
                        const std::string& value, const DeterminedSeries& series,
                        std::size_t width) {
  TextTable table({place, value + (series.whole() ? "" : ", determined part"), "U/µm"});
  const double u_m = column_u(series.u_m);
  for (std::size_t i = 0; i < series.place_m.size(); ++i) {
    const double U_m = series.U_m(i);
    table.add({in_mm(series.place_m[i]), um_with_u(series.seen_m[i], series.u_m[i], u_m),
               um_to_place(U_m, u_m > 0 ? series.k[i] * u_m : U_m)});
  }
  return title +
         (series.whole() ? ", peak to valley " : ", peak to valley of the determined part ") +
         in_um(series.zone_m()) +
         " µm\nnot determined and not included: " + undetermined_text(series) + "\n" +
         table.text(width);
}

// "U (k = 4.3) is the expanded uncertainty. "; empty if U is unknown.
std::string expanded_text(const Separation& fit) {
  std::vector<double> k = fit.machine.k;
  k.insert(k.end(), fit.target.k.begin(), fit.target.k.end());
  if (k.empty() || !std::all_of(k.begin(), k.end(), [](double x) { return std::isfinite(x); }))
    return "";
  const auto [least, most] = std::minmax_element(k.begin(), k.end());
  const std::string from = plain_number(*least, 3), to = plain_number(*most, 3);
  return "U (k = " + from + (from == to ? "" : " to " + to) +
         ", 95 %) is the expanded uncertainty. ";
}

std::string fit_text(const Separation& fit) {
  std::string text = std::to_string(fit.readings) + " readings, " + std::to_string(fit.unknowns) +
                     " unknowns, rank " + std::to_string(fit.rank);
  if (fit.freedom() > 0)
    text += "; residuals of the fit " + in_um(fit.residual_m) + " µm (RMS, " +
            std::to_string(fit.freedom()) + " degrees of freedom)";
  else
    text +=
        "\nThe fit has no degrees of freedom, so mdof cannot detect a wrong order, sign or length "
        "of the stated turns\nand shifts. Measure another set-up to make a test possible";
  return text + "\n";
}

std::string list(const std::vector<double>& values, double (*to_unit)(double)) {
  std::string text;
  for (const double v : values)
    text += (text.empty() ? "[" : ", ") + plain_number(to_unit(v), kDigits);
  return text + "]";
}

std::string heights(const std::vector<double>& height_m) {
  std::string text;
  for (const double h : height_m)
    text += (text.empty() ? "[[" : ", [") + plain_number(to_um(h), kDigits) + "]";
  return text + "]";
}

// The root mean square of u over all places; NaN: unknown.
double mean_u(const DeterminedSeries& series) {
  double sum = 0;
  for (const double u : series.u_m) sum += u * u;
  return std::sqrt(sum / static_cast<double>(series.u_m.size()));
}

// The warnings in a file. mdof recognises files with simulated data by these words; they must
// therefore not change.
std::string marks_text(const SeparationRecord& record) {
  std::string text = record.simulated ? "# simulated data: no machine was measured\n" : "";
  for (const std::string& mark : record.marks) text += "# " + mark + "\n";
  return text;
}

std::string provenance_comment(const SeparationRecord& record) {
  std::string text = "# Height of the " + std::string(to_string(record.surface)) +
                     " surface of the target, separated from the machine's " + record.error +
                     " (mdof separate " + record.method + ", " + record.created_utc + ")\n";
  text += marks_text(record);
  if (!record.probe.empty()) text += "# readings of probe " + record.probe + " only\n";
  for (const SeparationSource& s : record.sources) {
    std::string name = s.name;
    for (char& c : name)
      if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = '?';
    text += "# source " + name + ", sha256 " + s.sha256 + ": " + turned_text(s) + ", zero at " +
            plain_number(to_mm(s.shift_m), kDigits) + " mm\n";
  }
  return text + "# not determined and not included: " + undetermined_text(record.result.target) +
         "\n";
}

}  // namespace

std::string undetermined_text(const DeterminedSeries& series) {
  std::vector<std::string> words;
  for (const UndeterminedShape& shape : series.unseen) words.push_back(shape.name);
  return words.empty() ? "nothing" : joined(words);
}

std::string separation_text(const SeparationRecord& record, std::size_t width) {
  const Separation& r = record.result;
  const std::string of = record.probe.empty() ? "" : " at probe " + record.probe;
  return noise_only_notice(r.noise_only) + simulated_notice(record.simulated) +
         sources_text(record, width) + fit_text(r) + "\n" +
         series_text("machine: " + record.error + of, "encoder/mm", record.error + "/µm", r.machine,
                     width) +
         "\n" +
         series_text("target: height of the " + std::string(to_string(record.surface)) +
                         " surface along " + along(record) + " in set-up 1",
                     "place/mm", "height/µm", r.target, width) +
         "\n" +
         wrapped("± is the standard uncertainty u (" + r.u_reason + "). " + expanded_text(r) +
                     "u does not include: " + separation_u_omits(),
                 width) +
         "\n";
}

std::string separation_csv(const SeparationRecord& record) {
  CsvText csv;
  csv.cells({"series", "place_mm", "seen_um", "u_um", "U_um", "whole", "u_covers", "k", "nu_eff"});
  csv.end_row();
  const auto add = [&](std::string_view name, const DeterminedSeries& series) {
    for (std::size_t i = 0; i < series.place_m.size(); ++i) {
      csv.cell(name).cell(to_mm(series.place_m[i])).cell(to_um(series.seen_m[i]));
      csv.cell(to_um(series.u_m[i])).cell(to_um(series.U_m(i)));
      csv.cell(series.whole() ? 1LL : 0LL).cells({record.result.u_reason});
      csv.cell(series.k[i]).cell(series.freedom[i]);
      csv.end_row();
    }
  };
  add("machine", record.result.machine);
  add("target", record.result.target);
  return noise_only_comment(record.result.noise_only) + marks_text(record) + csv.take();
}

std::string separation_plane_toml(const SeparationRecord& record) {
  const DeterminedSeries& target = record.result.target;
  const double u_m = mean_u(target);
  std::string text = noise_only_comment(record.result.noise_only) + provenance_comment(record) +
                     "# A rig with a [[plane]] table needs one [[plane]] table for each surface "
                     "that the probes measure.\n"
                     "[[plane]]\n"
                     "id = \"" +
                     to_string(record.surface) + "\"\nnormal = \"" + along(record) +
                     "\"\nflatness_first_mm = " + list(target.place_m, to_mm) +
                     "\nflatness_second_mm = [0]\nflatness_um = " + heights(target.seen_m) + "\n";
  return text + (std::isfinite(u_m) ? "u_flatness_um = " + plain_number(to_um(u_m), 3) + "\n"
                                    : "# u_flatness_um: " + record.result.u_reason + "\n");
}

}  // namespace mdof::tools
