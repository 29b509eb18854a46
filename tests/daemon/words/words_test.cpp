#include "daemon/words/words.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <sstream>

namespace mdof {
namespace {

std::set<std::string> fields_of(const std::string& pattern) {
  std::set<std::string> fields;
  for (auto open = pattern.find('{'); open != std::string::npos; open = pattern.find('{', open + 1))
    fields.insert(pattern.substr(open + 1, pattern.find_first_of(":}", open) - open - 1));
  return fields;
}

std::set<std::string> keys_of(NoticeCode code) {
  std::istringstream words{std::string(keys(code))};
  return {std::istream_iterator<std::string>(words), {}};
}

std::vector<NoticeCode> all_codes() {
  std::vector<NoticeCode> codes;
#define NOTICE(code, severity, keys) codes.push_back(NoticeCode::code);
#include "schema/notice/notice_codes.inc"
#undef NOTICE
  return codes;
}

constexpr words::Language kLanguages[] = {words::Language::english, words::Language::german};

// The sentence of a notice has a field for each key of the notice and no other field, except the
// subject.
TEST(Catalogue, EachCodeHasATextWithItsKeys) {
  for (const NoticeCode code : all_codes()) {
    for (const auto language : kLanguages) {
      const std::string pattern = words::pattern(code, language);
      std::set<std::string> fields = fields_of(pattern);
      fields.erase("subject");
      EXPECT_FALSE(pattern.empty()) << to_string(code);
      EXPECT_EQ(fields, keys_of(code)) << to_string(code);
      EXPECT_EQ(std::count(pattern.begin(), pattern.end(), '{'),
                std::count(pattern.begin(), pattern.end(), '}'))
          << to_string(code);
    }
  }
}

// The subject is in the texts of both languages or in neither. Except for values of the notice,
// the two texts have different words.
TEST(Catalogue, GermanHasTheSameContentInOtherWords) {
  const auto names_subject = [](const std::string& pattern) {
    return pattern.find("{subject") != std::string::npos;
  };
  for (const NoticeCode code : all_codes()) {
    const std::string english = words::pattern(code),
                      german = words::pattern(code, words::Language::german);
    EXPECT_EQ(names_subject(german), names_subject(english)) << to_string(code);
    if (english != "{words}") {
      EXPECT_NE(german, english) << to_string(code);
    }
  }
}

TEST(Catalogue, CoveredContributionsHaveTextsInBothLanguages) {
  const Covers all = {
#define COVERED(code, english, german) Covered::code,
#include "schema/uncertainty/covers.inc"
#undef COVERED
  };
  std::set<std::string> sentences;
  for (const Covered each : all)
    for (const auto language : kLanguages) sentences.insert(words::text({each}, language));
  EXPECT_EQ(sentences.size(), 2 * all.size());  // no text is empty, and no text is used twice
  EXPECT_EQ(sentences.count(""), 0u);
  EXPECT_EQ(words::text({Covered::noise_only, Covered::nothing_declared}, words::Language::german),
            "nur Rauschen (es sind keine Unsicherheiten angegeben)");
}

TEST(Catalogue, ContributorsHaveNamesInBothLanguages) {
  const ContributorKind all[] = {
#define CONTRIBUTOR(code, english, german) ContributorKind::code,
#include "schema/uncertainty/contributor_names.inc"
#undef CONTRIBUTOR
  };
  for (const auto language : kLanguages) {
    std::set<std::string> names;
    for (const ContributorKind kind : all)
      names.insert(words::text(ContributorName{kind, "D"}, language));
    EXPECT_EQ(names.size(), std::size(all));  // no text is used twice
    EXPECT_EQ(names.count(""), 0u);
  }
  for (const ContributorKind kind : all) {
    const auto names_subject = [&](words::Language language) {
      return words::text(ContributorName{kind, "#"}, language).find('#') != std::string::npos;
    };
    EXPECT_EQ(names_subject(words::Language::english), names_subject(words::Language::german));
  }
  const ContributorName of_two{ContributorKind::probe_position_z, "D", {"X", "Y"}};
  EXPECT_EQ(words::text(of_two, words::Language::english), "X and Y, probe D: position z");
  EXPECT_EQ(words::text(of_two, words::Language::german), "X und Y, Sensor D: Position z");
}

TEST(Catalogue, GermanLinesHaveSingularAndPlural) {
  const auto line = [](const Notice& n) { return words::line(n, words::Language::german); };
  const auto left_out = [](int stops) {
    return notice(NoticeCode::stop_at_end_of_log, "", {{"stops", stops}, {"positions_mm", "5.5"}});
  };
  EXPECT_EQ(
      line(left_out(1)),
      "Hinweis: 1 Halt wurde ausgelassen (einmal angefahren, am Ende des Protokolls): bei 5.5 mm");
  EXPECT_EQ(line(left_out(2)),
            "Hinweis: 2 Halte wurden ausgelassen (einmal angefahren, am Ende des Protokolls): bei "
            "5.5 mm");
  const auto missing = [](int n) {
    return notice(NoticeCode::targets_missing, "",
                  {{"missing", n}, {"of", 9}, {"targets", "targets 2, 4"}});
  };
  EXPECT_EQ(line(inherited("run 3", missing(1))),
            "Messung 3: 1 von 9 Sollpositionen wurde nie gemessen: Sollpositionen 2, 4");
  EXPECT_EQ(line(missing(2)), "2 von 9 Sollpositionen wurden nie gemessen: Sollpositionen 2, 4");
  EXPECT_EQ(
      line(notice(NoticeCode::set_ups_contradict, "", {{"chi_square", 40.5}, {"freedom", 8}})),
      "ungültig: die Aufspannungen widersprechen sich: Chi-Quadrat ist 40.5 bei 8 "
      "Freiheitsgraden, was Rauschen allein kaum je ergibt; Verschiebungen und Drehungen, "
      "Wiederholpräzision der Maschine und u der Messwerte prüfen");
  const auto unsolved = [&](const char* targets) {
    return line(notice(NoticeCode::visit_missing, "",
                       {{"run", 2}, {"approach", "forward"}, {"targets", targets}}));
  };
  EXPECT_EQ(unsolved("targets 1, 10 to 13"),
            "Lauf 2, vorwärts: keine Anfahrt von Sollpositionen 1, 10 bis 13");
  EXPECT_EQ(unsolved("any target"), "Lauf 2, vorwärts: keine Anfahrt von irgendeiner Sollposition");
  EXPECT_EQ(line(notice(NoticeCode::air_of_run, "", {{"conditions", "20 to 21 °C"}})).find(" to "),
            std::string::npos);
  const std::string drift = line(
      notice(NoticeCode::drift_removed, "",
             {{"changes", "EBX -332.41 ± 0.61 µrad from the first point to the last (1.11 min)"}}));
  EXPECT_NE(drift.find("µrad vom ersten Messpunkt bis zum letzten (1.11 min)"), std::string::npos);
  Notice older = notice(NoticeCode::u_unknown, "", {{"reason", "a"}});
  older.values.clear();
  EXPECT_EQ(line(older), "u ist unbekannt: unbekannt");
}

TEST(Catalogue, FieldsAreFilledByTheirFormat) {
  const Notice n = notice(NoticeCode::delays_by_motion, "B",
                          {{"delays_us", ""}, {"unknown", "A, C"}, {"effect_nm", 1234567.891}});
  const auto filled = [&](const char* pattern) { return words::filled(pattern, n); };
  EXPECT_EQ(filled("probe {subject}: {effect_nm}"), "probe B: 1234568");
  EXPECT_EQ(filled("{effect_nm:9}|{effect_nm:+.1f}|{effect_nm:.3g}"),
            "1234567.89|+1234567.9|1.23e+06");
  EXPECT_EQ(filled("{unknown}{unknown:? unknown|}{delays_us:?x|y}"), "A, C unknowny");
  EXPECT_EQ(filled("{other}"), "unknown");
  const Notice one = notice(NoticeCode::points_not_stored, "", {{"points", 1}});
  EXPECT_EQ(words::filled("{points:9} {points:?point|points}", one), "1 point");
  EXPECT_EQ(words::filled("{points:?point|points}",
                          notice(NoticeCode::points_not_stored, "", {{"points", 2}})),
            "points");
}

TEST(Catalogue, ALineNamesSourceAndSeverity) {
  const Notice doubtful = notice(NoticeCode::cycle_unknown);
  const Notice known = inherited("run 3", notice(NoticeCode::run_can_go_on));
  EXPECT_EQ(words::line(doubtful), words::text(doubtful));
  EXPECT_EQ(words::line(known),
            "information: run 3: " + words::text(notice(NoticeCode::run_can_go_on)));
}

// Numbers as they occur in a real run.
TEST(Catalogue, NumbersAreReadable) {
  EXPECT_EQ(
      words::text(notice(
          NoticeCode::stop_too_short, "",
          {{"length_s", 0.15}, {"position_mm", 20.00004}, {"time_s", 12.3456}, {"needed_s", 0.2}})),
      "a stop of 0.150 s at 20.0000 mm, 12.346 s after the first scan, was too short "
      "(0.200 s are needed) and was left out; stop longer, or change settle_s or min_length_s in "
      "[measure] (in mdof replay: --settle-s or --min-length-s)");
}

}  // namespace
}  // namespace mdof
