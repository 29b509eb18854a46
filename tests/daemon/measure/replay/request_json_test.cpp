#include "daemon/measure/replay/request_json.h"

#include <gtest/gtest.h>

#include <regex>

#include "schema/units.h"

namespace mdof::daemon {
namespace {

PipelineOptions asked_options() {
  PipelineOptions options;
  options.model = Model::exact;
  options.sequence.targets_m = {from_mm(0), from_mm(2), from_mm(4.1), from_mm(6.2)};
  options.repeats = 3;
  options.dwell.max_speed_m_s = 0.25;
  options.align.interval_s = {{"A", 0.1}, {"E", 0.25}};
  options.align.delay_s = {{"A", 0.00384}, {"B", 0.001}, {"E", -0.0065}};
  options.dwell.leave_s = 0.00384;
  options.remove_drift = true;
  options.on_the_fly = algo::OnTheFlyOptions{0.5, 0.25, -3.5, 61.25};
  return options;
}

TEST(RequestJson, IsReadBackUnchanged) {
  const RecordedRequest asked{
      "after \"scraping\"\n",
      {notice(NoticeCode::cycle_unknown), notice(NoticeCode::clock_not_settled, "t7")},
      asked_options()};
  const auto back = read_request_json(request_json(asked), {});
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(back->note, asked.note);
  EXPECT_EQ(back->notices, asked.notices);
  EXPECT_EQ(back->options.json(), asked.options.json());
  EXPECT_EQ(back->options.model, Model::exact);
  EXPECT_EQ(back->options.repeats, 3);
  EXPECT_EQ(back->options.align.interval_s, asked.options.align.interval_s);
  EXPECT_EQ(back->options.align.delay_s, asked.options.align.delay_s);
  EXPECT_EQ(back->options.dwell.leave_s, 0.00384);
  EXPECT_TRUE(back->options.remove_drift);
  EXPECT_EQ(back->options.on_the_fly->to_mm, 61.25);
}

// Each option that PipelineOptions::json() writes must also be read back. Otherwise a replay would
// evaluate the recording with other options than the original run.
TEST(RequestJson, EveryNumberOfTheOptionsIsReadBack) {
  const std::string text = asked_options().json();
  const std::regex number(R"(("[A-Za-z_]+":)([0-9][0-9.e+-]*))");
  int numbers = 0;
  for (auto at = std::sregex_iterator(text.begin(), text.end(), number);
       at != std::sregex_iterator(); ++at, ++numbers) {
    const std::string digits = (*at)[2], other = digits == "0" ? "17" : digits + "17";
    const std::string changed =
        text.substr(0, static_cast<std::size_t>(at->position(2))) + other + at->suffix().str();
    const auto back = read_options_json(changed, {});
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(back->json(), changed);
  }
  EXPECT_GE(numbers, 10);
}

TEST(RequestJson, TargetsAreReadBackBitForBit) {
  PipelineOptions options;
  for (int i = 0; i < 5000; ++i) options.sequence.targets_m.push_back(from_mm(0.037 + 0.1 * i));
  EXPECT_EQ(read_options_json(options.json(), {})->sequence.targets_m, options.sequence.targets_m);
}

TEST(RequestJson, ADatumIsReadBackCompletely) {
  const EncoderDatum data[] = {
      {EncoderDatum::Kind::none, 0, "qsb", "", ""},
      {EncoderDatum::Kind::set, from_mm(12.5), "t7", "2026-11-23T07:00:00Z", "anna"},
      {EncoderDatum::Kind::set, from_mm(-1.5e6), "t7", "2026-11-23T07:00:00Z", ""},
      {EncoderDatum::Kind::configured, 1e303, "t7", "", "anna"},
      {EncoderDatum::Kind::absolute, 0, "", "", "anna"},
  };
  for (const EncoderDatum& datum : data) {
    PipelineOptions options;
    options.datum = datum;
    const auto back = read_options_json(options.json(), {});
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(back->datum, datum) << options.json();
  }
}

TEST(RequestJson, MissingOptionsKeepTheirValues) {
  const PipelineOptions base = asked_options();
  EXPECT_EQ(read_request_json("", base)->options.json(), base.json());
  EXPECT_EQ(read_request_json("{}", base)->options.json(), base.json());
  const auto back =
      read_request_json(R"({"note":null,"options":{"dwell":{"settle_s":0.7}}})", base);
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(back->options.dwell.settle_s, 0.7);
  EXPECT_EQ(back->options.sequence.targets_m, base.sequence.targets_m);
}

TEST(RequestJson, NamesInvalidMembers) {
  const std::pair<const char*, const char*> cases[] = {
      {"{", "not a JSON"},
      {"[]", "not a JSON object"},
      {R"({"note":5})", "note"},
      {R"({"warnings":[1]})", "warnings"},
      {R"({"options":{"model":"magic"}})", "model"},
      {R"({"options":{"targets_mm":["x"]}})", "targets_mm"},
      {R"({"options":{"align":{"max_gap_s":"long"}}})", "max_gap_s"},
      {R"({"options":{"align":{"interval_s":{"A":0}}}})", "interval_s"},
      {R"({"options":{"align":{"delay_s":{"A":10.1}}}})", "delay_s"},
      {R"({"options":{"align":{"delay_s":{"A":-10.1}}}})", "delay_s"},
      {R"({"options":{"align":{"delay_s":[1]}}})", "delay_s"},
      {R"({"options":{"align":{"delay_s":{"A":1,"A":2}}}})", "options.align.delay_s"},
      {R"({"options":{"dwell":7}})", "dwell"},
      {R"({"options":{"dwell":{"settle_s":-0.1}}})", "options.dwell.settle_s"},
      {R"({"options":{"dwell":{"max_speed_mm_s":0}}})", "options.dwell.max_speed_mm_s"},
      {R"({"options":{"dwell":{"max_scans":0}}})", "options.dwell.max_scans"},
      {R"({"options":{"repeats":4294967297}})", "options.repeats"},
      {R"({"options":{"repeats":-1}})", "options.repeats"},
      {R"({"options":{"encoder_datum":7}})", "options.encoder_datum"},
      {R"({"options":{"encoder_datum":{"kind":"guessed"}}})", "options.encoder_datum.kind"},
      {R"({"options":{"encoder_datum":{"by":"anna"}}})", "options.encoder_datum.kind"},
      {R"({"notes":""})", "\"notes\" is unknown"},
      {R"({"options":{"new":[1]}})", "\"options.new\" is unknown"},
      {R"({"options":{"align":{"max_gap":1}}})", "\"options.align.max_gap\" is unknown"},
      {R"({"options":{"dwell":{"settle":1}}})", "\"options.dwell.settle\" is unknown"},
      {R"({"options":{"encoder_datum":{"kind":"set","kindt_mm":12.5}}})", "kindt_mm\" is unknown"},
      {R"({"options":{"repeats":1,"repeats":2}})", "\"options.repeats\" occurs twice"},
  };
  for (const auto& [text, says] : cases) {
    const auto back = read_request_json(text, {});
    ASSERT_FALSE(back) << text;
    EXPECT_NE(back.error().message.find(says), std::string::npos) << back.error().message;
  }
}

}  // namespace
}  // namespace mdof::daemon
