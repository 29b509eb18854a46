// The JSON object of one device in device.list, and the value of live.update.
#include "daemon/station/live_json.h"

#include <gtest/gtest.h>

#include <functional>

#include "tests/daemon/measure/test_axis.h"

namespace mdof::daemon {
namespace {

std::string with_rates(double stated_hz, double measured_hz) {
  DeviceStatus status;
  status.info.rate_hz = stated_hz;
  status.measured_hz = measured_hz;
  return device_json(status);
}

TEST(LiveJson, RateIsTheStatedElseTheMeasuredRateElseNull) {
  EXPECT_NE(with_rates(1000, 990.5).find("\"rate_hz\":1000,"), std::string::npos);
  EXPECT_NE(with_rates(0, 49.75).find("\"rate_hz\":49.75,"), std::string::npos);
  EXPECT_NE(with_rates(0, 0).find("\"rate_hz\":null,"), std::string::npos) << with_rates(0, 0);
}

// The value of live.update after the last scan of an axis that has stopped several times.
class LiveView {
 public:
  LiveView() { axis_.pass_both_ways({0, 5, 10}); }
  // Measures 200 scans at rest after `change` has changed their block.
  std::string after(const std::function<void(SampleBlock&)>& change) {
    const std::size_t begin = axis_.scans();
    axis_.stand(0.2);
    SampleBlock before = axis_.block(given_, begin), rest = axis_.block(begin, axis_.scans());
    given_ = axis_.scans();
    EXPECT_TRUE(before.scans() == 0 || pipeline_.push(before));
    change(rest);
    EXPECT_TRUE(pipeline_.push(rest));
    return live_json(rig_, pipeline_, {}, {});
  }

 private:
  Rig rig_ = five_probe_rig();
  TestAxis axis_;
  std::size_t given_ = 0;
  Pipeline pipeline_ = Pipeline::create(rig_, PipelineOptions()).value();
};

std::string quality_of(const std::string& json, const std::string& probe) {
  const auto at = json.find("\"quality\":\"", json.find("\"id\":\"" + probe + "\"")) + 11;
  return json.substr(at, json.find('"', at) - at);
}

TEST(LiveJson, AProbeIsSuspectAndTheErrorsAreNullWhileItIsFrozen) {
  LiveView view;
  const std::string before = view.after([](SampleBlock&) {});
  EXPECT_EQ(quality_of(before, "B"), "good");
  EXPECT_NE(before.find("\"errors\":{"), std::string::npos) << before;
  const std::string frozen =
      view.after([](SampleBlock& block) { block.value[2].assign(block.scans(), 1.25); });
  EXPECT_EQ(quality_of(frozen, "A"), "good");
  EXPECT_EQ(quality_of(frozen, "B"), "suspect");
  EXPECT_NE(frozen.find("\"errors\":null"), std::string::npos) << frozen;
  const std::string recovered = view.after([](SampleBlock&) {});
  EXPECT_EQ(quality_of(recovered, "B"), "good");
  EXPECT_NE(recovered.find("\"errors\":{"), std::string::npos) << recovered;
}

void lose_position(SampleBlock& block) {
  block.value[0].assign(block.scans(), kNaN);
  block.quality.resize(block.channels.size());
  block.quality[0].assign(block.scans(), Quality::missing);
}

TEST(LiveJson, ProbesKeepTheirQualityWithoutAPosition) {
  LiveView view;
  const std::string json = view.after([](SampleBlock& block) {
    lose_position(block);
    block.value[3].assign(block.scans(), kNaN);
  });
  EXPECT_NE(json.find("\"encoder_mm\":null,\"encoder_quality\":\"missing\",\"still\":null"),
            std::string::npos)
      << json;
  for (const char* probe : {"A", "B", "D", "E"}) EXPECT_EQ(quality_of(json, probe), "good");
  EXPECT_EQ(quality_of(json, "C"), "missing");
  EXPECT_NE(json.find("\"errors\":null"), std::string::npos) << json;
}

TEST(LiveJson, AFrozenProbeRecoversAlsoWithoutAPosition) {
  LiveView view;
  const auto freeze = [](SampleBlock& block) { block.value[2].assign(block.scans(), 1.25); };
  EXPECT_EQ(quality_of(view.after(freeze), "B"), "suspect");
  EXPECT_EQ(quality_of(view.after(lose_position), "B"), "good");
}

TEST(LiveJson, ASuspectPositionHasNoErrorsAndDoesNotChangeTheQualityOfProbes) {
  LiveView view;
  const std::string json = view.after([](SampleBlock& block) {
    block.quality.resize(block.channels.size());
    block.quality[0].assign(block.scans(), Quality::suspect);
  });
  EXPECT_NE(json.find("\"encoder_quality\":\"suspect\""), std::string::npos) << json;
  EXPECT_EQ(quality_of(json, "A"), "good");
  EXPECT_NE(json.find("\"errors\":null"), std::string::npos) << json;
}

}  // namespace
}  // namespace mdof::daemon
