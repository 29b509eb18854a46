#include "daemon/output/report/report.h"

#include "daemon/measure/gate/gate.h"
#include "daemon/output/charts/labels.h"
#include "daemon/output/charts/run/points.h"
#include "daemon/output/report/html.h"
#include "daemon/output/report/numbers.h"
#include "daemon/output/report/replay_command.h"
#include "daemon/output/report/sections.h"
#include "schema/axis.h"
#include "schema/base/sha256.h"
#include "schema/imported/series.h"
#include "schema/units.h"

namespace mdof::report {

using output::Phrase;
using output::phrase;

namespace {

std::string name_of_run(const ReportRun& run, Language language) {
  const RunHeader& h = run.results.run.header;
  return phrase(Phrase::run_axis, language, {std::to_string(h.id), std::string(1, letter(h.axis))});
}

// Writes the warnings that a reader must see first.
void write_alarms(Html& html, const Report& report) {
  for (const ReportRun& run : report.runs) {
    const bool noise_only = run.results.uncertainty.noise_only;
    for (const std::string& mark : charts::with_noise_only_mark(
             noise_only, daemon::warning_marks(run.results.run, report.language), report.language))
      html.element("p", name_of_run(run, report.language) + ": " + mark, "alarm");
  }
}

std::string place_text(const ReportFacts& facts, Language language) {
  if (facts.place.empty()) return "";
  const Phrase place = facts.place == "laboratory" ? Phrase::in_laboratory
                       : facts.place == "customer" ? Phrase::at_customer
                                                   : Phrase::elsewhere;
  return phrase(place, language);
}

void write_title(Html& html, const Report& report) {
  const Language language = report.language;
  const auto stated = [&](const std::string& text) {
    return text.empty() ? std::string(phrase(Phrase::not_stated, language)) : text;
  };
  std::string runs;
  for (const ReportRun& run : report.runs)
    runs += (runs.empty() ? "" : "; ") + name_of_run(run, language);
  html.element("h1", phrase(Phrase::report_title, language));
  const ReportFacts& facts = report.facts;
  html.facts({{phrase(Phrase::report_number, language), facts.number},
              {phrase(Phrase::issued_on, language), stated(facts.issued)},
              {phrase(Phrase::customer, language), stated(facts.customer)},
              {phrase(Phrase::customer_address, language), facts.customer_address},
              {phrase(Phrase::machine, language), stated(facts.machine)},
              {phrase(Phrase::manufacturer, language), facts.manufacturer},
              {phrase(Phrase::serial, language), stated(facts.serial_number)},
              {phrase(Phrase::laboratory_that_measured, language), stated(facts.laboratory)},
              {phrase(Phrase::laboratory_address, language), facts.laboratory_address},
              {phrase(Phrase::laboratory_country, language), facts.country},
              {phrase(Phrase::operator_name, language), stated(facts.operator_name)},
              {phrase(Phrase::measured_on, language), facts.date},
              {phrase(Phrase::measured_at, language), place_text(facts, language)},
              {phrase(Phrase::stated_conditions, language), facts.conditions},
              {phrase(Phrase::runs, language), runs},
              {phrase(Phrase::report_by, language), report.software_version}});
  html.element("p", phrase(Phrase::what_the_report_is, language), "quiet");
  if (language != Language::english)
    html.element("p", phrase(Phrase::language_note, language), "quiet");
}

void write_squareness(Html& html, const charts::SquarenessOfPair& pair,
                      const std::vector<Decided>& decided, Language language) {
  const std::string a(1, letter(pair.axes.a)), b_axis(1, letter(pair.axes.b));
  html.element("h2", phrase(Phrase::squareness, language, {a, b_axis}));
  if (!pair.results) {
    html.element("p", phrase(Phrase::left_out, language, {pair.reason}));
    return;
  }
  const std::string angle = squareness_name(pair.axes);
  const auto of = [&](Phrase name) { return std::string(phrase(name, language)); };
  const Budget& b = pair.results->budget;
  const bool known = std::isfinite(b.u);
  const double U = to_urad(b.U);
  html.table({of(Phrase::figure), of(Phrase::value), of(Phrase::unit), "u", "U (95 %)", "k"},
             {{angle, value_text(to_urad(pair.results->squareness.error_rad), to_urad(b.u)), "µrad",
               known ? uncertainty_text(to_urad(b.u)) : of(Phrase::unknown),
               known ? uncertainty_text(U) : of(Phrase::unknown),
               known ? charts::fixed_text(b.coverage_factor, 2) : of(Phrase::unknown)}},
             "numbers");
  html.element("p", phrase(Phrase::squareness_is, language,
                           {angle, a, b_axis, squareness_sign(pair.axes) > 0 ? "+" : "−"}));
  html.element("p", phrase(Phrase::u_covers, language, {words::text(covers(b), language)}));
  std::string keys;
  for (const std::string& key : b.not_declared) keys += (keys.empty() ? "" : ", ") + key;
  if (!keys.empty()) html.element("p", phrase(Phrase::not_declared, language, {keys}));
  html.element("p", phrase(Phrase::at_the_fixture, language), "quiet");
  std::vector<Decided> of_pair;
  for (const Decided& each : decided)
    if (each.figure == b.figure) of_pair.push_back(each);
  if (!of_pair.empty()) {
    html.element("h3", of(Phrase::decision));
    write_decided(html, of_pair, {b}, language);
  }
  html.figure(charts::squareness_svg(*pair.results, language));
}

// The style of the bottom margin of each printed page: the number of the report, and the page.
std::string page_style(const Report& report) {
  const auto string_of = [](const std::string& text) { return '"' + css_escaped(text) + '"'; };
  const std::string title = phrase(Phrase::report_title, report.language);
  const std::string& number = report.facts.number;
  return "@page{@bottom-left{content:" + string_of(number.empty() ? title : title + " " + number) +
         "}@bottom-right{content:" +
         string_of(std::string(phrase(Phrase::page, report.language)) + " ") + "counter(page)" +
         string_of(" " + std::string(phrase(Phrase::of_pages, report.language)) + " ") +
         "counter(pages)}}";
}

void write_attachments(Html& html, const Report& report) {
  if (report.attachments.empty()) return;
  html.element("h2", phrase(Phrase::attachments, report.language));
  for (const Attachment& file : report.attachments)
    html.attachment(
        phrase(Phrase::attached_file, report.language,
               {file.file_name, std::to_string(file.bytes.size()), sha256_hex(file.bytes)}),
        file.file_name, file.media_type, file.bytes);
}

}  // namespace

void write_provenance(Html& html, const ReportRun& run, Language language) {
  const RunHeader& h = run.results.run.header;
  html.element("h3", phrase(Phrase::provenance, language));
  html.facts({{phrase(Phrase::recording_file, language),
               h.provenance.recording_kind + ", " + h.provenance.recording_path},
              {phrase(Phrase::recording_sha256, language), h.provenance.recording_sha256},
              {phrase(Phrase::result_sha256, language), run.result_sha256},
              {phrase(Phrase::measured_by, language), h.provenance.software_version}});
  html.element("p",
               phrase(is_imported(h) ? Phrase::how_to_import : Phrase::how_to_replay, language));
  html.element("pre", replay_command(run.results.run), "replay");
  if (const std::string file = rig_file(h); !file.empty()) {
    html.element("p", phrase(Phrase::save_rig, language, {file}));
    html.element("pre", h.provenance.rig_text, "rig");
  }
}

std::string report_html(const Report& report) {
  const Language language = report.language;
  Html html;
  if (!report.head.empty()) html.raw("<header>\n" + report.head + "</header>\n");
  write_alarms(html, report);
  write_title(html, report);
  for (const daemon::Comparison& comparison : report.comparisons)
    write_comparison(html, comparison, language);
  for (const ReportRun& run : report.runs) {
    html.element("h2", name_of_run(run, language));
    write_results(html, run, language);
    write_decisions(html, run, language);
    write_conditions(html, run, language);
    if (!is_imported(run.results.run.header)) write_fixture(html, run, language);
    write_notices(html, run, language);
    write_charts(html, run, language);
    write_points(html, run, language);
    write_provenance(html, run, language);
  }
  for (const auto& pair : report.squareness) write_squareness(html, pair, report.decided, language);
  write_attachments(html, report);
  html.element("p", phrase(Phrase::end_of_report, language), "end");
  return html.take(output::code_of(language), phrase(Phrase::report_title, language),
                   !report.head.empty(), page_style(report));
}

}  // namespace mdof::report
