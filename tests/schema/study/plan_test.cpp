// Valid plans of studies, and the error of each kind of invalid plan.
#include "schema/study/plan.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "schema/base/files.h"
#include "schema/study/distribution.h"

namespace mdof {
namespace {

const std::string kFolder = std::string(MDOF_TEST_DATA) + "/sensitivity/";
const std::string kHead = "name = \"t\"\nrig = \"../five-probe/rig_X.toml\"\n";

std::string error_of(const std::string& text) {
  const auto plan = parse_study_plan(text, kFolder + "plan.toml");
  return plan ? "no error" : plan.error().message;
}

Result<StudyPlan> example(const std::string& name) {
  const std::string file = kFolder + name + ".toml";
  return parse_study_plan(read_text_file(file).value(), file);
}

std::string quantity(const std::string& rest, const std::string& name = "probe.A.x_um") {
  return kHead + "[[quantity]]\nname = \"" + name + "\"\n" + rest;
}

const PlannedQuantity& quantity_of(const StudyPlan& plan, const std::string& name) {
  for (const auto& q : plan.quantities)
    if (q.name == name) return q;
  ADD_FAILURE() << name << " is missing";
  return plan.quantities.front();
}

TEST(StudyPlan, ReadsTheExamples) {
  for (const char* file : {"simulation_1", "mounting", "squareness", "whole_run"}) {
    const auto plan = example(file);
    EXPECT_TRUE(plan) << plan.error().message;
  }
}

TEST(StudyPlan, ReadsACompletePlan) {
  const auto plan = example("mounting").value();
  EXPECT_EQ(plan.name, "mounting of the five-probe fixture");
  EXPECT_EQ(plan.rig.probes.size(), 5U);
  EXPECT_EQ(plan.model, Model::exact);
  EXPECT_EQ(plan.forward, Forward::rigid);
  EXPECT_EQ(plan.trials, 200'000U);
  EXPECT_EQ(plan.seed, 7U);
  EXPECT_EQ(plan.coverage, 0.95);
  ASSERT_EQ(plan.outputs.size(), 6U);
  EXPECT_EQ(plan.outputs[5].kind, OutputKind::straightness);
  EXPECT_EQ(quantity_of(plan, "truth.EBX_urad").distribution.high, 100);
  const auto& yaw = quantity_of(plan, "installation.yaw_mrad").distribution;
  EXPECT_EQ(yaw.kind, Distribution::Kind::rectangular);
  EXPECT_EQ(yaw.low, -2);
  const auto& temperature = quantity_of(plan, "temperature.target_K").distribution;
  EXPECT_EQ(temperature.sample.size(), 48U);
  EXPECT_TRUE(std::is_sorted(temperature.sample.begin(), temperature.sample.end()));
  ASSERT_EQ(plan.correlations.size(), 1U);
  EXPECT_EQ(plan.correlations[0].quantities.size(), 5U);
  EXPECT_EQ(plan.correlations[0].matrix[1], 0.8);
  EXPECT_EQ(plan.correlations[0].matrix[6], 1);
  EXPECT_EQ(plan.binned_key, "travel_mm");
  EXPECT_EQ(plan.bins, 12U);
  EXPECT_EQ(plan.adaptive->tolerances.at("EBX_urad"), 0.2);
  EXPECT_EQ(plan.indices->trials, 4096U);
  ASSERT_EQ(plan.allocations.size(), 1U);
  EXPECT_EQ(plan.allocations[0].tolerances.size(), 2U);
  EXPECT_EQ(plan.compare->name, "five probes, 20 mm apart");
  EXPECT_DOUBLE_EQ(plan.fixture_per_K, 23e-6);
}

TEST(StudyPlan, DefaultTrueErrorsAreThoseOfThePaper) {
  const auto plan = parse_study_plan(kHead, kFolder + "plan.toml").value();
  EXPECT_EQ(quantity_of(plan, "travel_mm").distribution.high, 60);
  EXPECT_EQ(quantity_of(plan, "truth.EYX_um").distribution.low, -50);
  EXPECT_EQ(quantity_of(plan, "truth.ECX_urad").distribution.high, 1000);
  EXPECT_EQ(plan.outputs.size(), 5U);
}

TEST(StudyPlan, EveryNameIsValidAndAStarMeansAllProbes) {
  const Rig rig = load_rig(std::string(MDOF_TEST_DATA) + "/five-probe/rig_X.toml").value();
  for (const std::string& name : quantity_names(rig)) {
    const auto targets = resolve_quantity(name, rig);
    ASSERT_TRUE(targets) << name;
    EXPECT_EQ(targets->size(), name.starts_with("probe.*") ? 5U : 1U) << name;
  }
}

// The number of bins is limited, because each bin needs a histogram for each output and thread.
TEST(StudyPlan, AcceptsUpToTwoHundredBins) {
  const auto plan = parse_study_plan(kHead + "[bins]\ncount = 200\n", kFolder + "plan.toml");
  ASSERT_TRUE(plan) << plan.error().message;
  EXPECT_EQ(plan->bins, 200U);
}

struct Bad {
  std::string text, says;
};

// Without this function, the name of the test would contain the address of the object.
void PrintTo(const Bad& bad, std::ostream* out) {
  *out << bad.says;
}

class BadPlan : public testing::TestWithParam<Bad> {};

TEST_P(BadPlan, IsRejectedWithPlaceAndRemedy) {
  const std::string error = error_of(GetParam().text);
  EXPECT_NE(error.find("plan.toml"), std::string::npos) << error;
  EXPECT_NE(error.find(GetParam().says), std::string::npos) << error;
}

const std::string kNormal = "distribution = \"normal\"\nsd = 1\n";
const std::string kTwo = quantity(kNormal) + "[[quantity]]\nname = \"probe.B.x_um\"\n" + kNormal;

INSTANTIATE_TEST_SUITE_P(
    Plans, BadPlan,
    testing::Values(
        Bad{"name = 1", "name: must be a string"}, Bad{"name = \"t\"\n", "rig: is missing"},
        Bad{"name = \"t\"\nrig = \"none.toml\"\n", "plan.toml:2: rig: "},
        Bad{kHead + "modle = \"exact\"\n", "did you mean \"model\"?"},
        Bad{kHead + "model = \"exakt\"\n", "did you mean \"exact\"?"},
        Bad{kHead + "trials = 0\n", "plan.toml:3: trials: must be from 1"},
        Bad{kHead + "coverage = 1.0\n", "coverage: must be more than 0 and less than 1"},
        Bad{kHead + "coverage = 0\n", "coverage: must be more than 0 and less than 1"},
        Bad{kHead + "seed = -1\n", "seed: must be from 0"},
        Bad{kHead + "outputs = [\"EBX_um\"]\n", "did you mean \"EYX_um\"?"},
        Bad{kHead + "outputs = [\"EYX_um\", \"EYX_um\"]\n", "listed twice"},
        Bad{kHead + "outputs = []\n", "at least one output"},
        Bad{kHead + "outputs = [\"EC0Y_urad\"]\n", "\"rig_y\" in [squareness]"},
        Bad{kHead + "[truth]\nEYX_um = [5, -5]\n", "low less than high"},
        Bad{kHead + "[truth]\nEYY_um = [0, 5]\n", "did you mean"},
        Bad{quantity(kNormal, "probe.A.posiion_um"), "did you mean \"probe.A.position_um\"?"},
        Bad{quantity(kNormal, "probe.F.x_um"), "did you mean \"probe."},
        Bad{quantity(kNormal, "instalation.yaw_mrad"), "did you mean \"installation.yaw_mrad\"?"},
        Bad{quantity("distribution = \"gauss\"\n"), "plan.toml:5: quantity[1].distribution"},
        Bad{quantity("distribution = \"norml\"\n"), "did you mean \"normal\"?"},
        Bad{quantity("distribution = \"normal\"\nsd = -1\n"),
            "plan.toml:6: quantity[1].sd: must be greater than zero"},
        Bad{quantity("distribution = \"normal\"\nsd = 0\n"), "distribution = \"constant\""},
        Bad{quantity("distribution = \"normal\"\nsd = inf\n"), "finite"},
        Bad{quantity("distribution = \"t\"\nscale = 1\ndof = 0.5\n"), "dof: must be from 1"},
        Bad{quantity("distribution = \"uniform\"\nlow = 1\nhigh = 1\n"), "greater than low"},
        Bad{quantity("distribution = \"uniform\"\nlow = 0\nhalf_width = 1\n"), "contradicts"},
        Bad{quantity("distribution = \"uniform\"\nhalf_width = -1\n"),
            "half_width: must be greater"},
        Bad{quantity("distribution = \"triangular\"\nlow = 0\nhigh = 1\nmode = 2\n"),
            "between low and high"},
        Bad{quantity("distribution = \"trapezoidal\"\nlow = 0\nhigh = 1\nbeta = 2\n"), "beta"},
        Bad{quantity("distribution = \"constant\"\nvalue = -3\n", "probe.*.position_um"),
            "must not be negative, because probe.*.position_um is a radius"},
        Bad{quantity("distribution = \"uniform\"\nhalf_width = 3\n", "probe.A.tilt_mrad"),
            "is a tilt"},
        Bad{quantity("distribution = \"empirical\"\nfile = \"none.csv\"\n"), "none.csv"},
        Bad{quantity("distribution = \"empirical\"\n"), "file: is missing"},
        Bad{quantity(kNormal) + "[[quantity]]\nname = \"probe.*.x_um\"\n" + kNormal,
            "probe.A.x_um is given twice"},
        Bad{kTwo + "[[correlation]]\nquantities = [\"probe.A.x_um\"]\ncoefficient = 0.5\n",
            "at least two"},
        Bad{kTwo + "[[correlation]]\nquantities = [\"probe.A.x_um\", \"probe.C.x_um\"]\n"
                   "coefficient = 0.5\n",
            "probe.C.x_um has no [[quantity]]"},
        Bad{kTwo + "[[correlation]]\nquantities = [\"probe.A.x_um\", \"probe.B.x_um\"]\n",
            "matrix: is missing"},
        Bad{kTwo + "[[correlation]]\nquantities = [\"probe.A.x_um\", \"probe.B.x_um\"]\n"
                   "matrix = [[1, 0.5], [0.4, 1]]\n",
            "symmetric"},
        Bad{kTwo + "[[correlation]]\nquantities = [\"probe.A.x_um\", \"probe.B.x_um\"]\n"
                   "matrix = [[1, 0.5]]\n",
            "a row and a column for each of the 2"},
        Bad{kTwo + "[[correlation]]\nquantities = [\"probe.A.x_um\", \"probe.B.x_um\"]\n"
                   "coefficient = 1\n",
            "between -1 and 1"},
        Bad{kHead + "[bins]\nquantity = \"probe.A.x_um\"\n", "rectangular"},
        Bad{kHead + "[bins]\ncount = 0\n", "count: must be from 1 to 200"},
        Bad{kHead + "[bins]\ncount = -1\n", "count: must be from 1 to 200"},
        Bad{kHead + "[bins]\ncount = 201\n", "bins.count: must be from 1 to 200"},
        Bad{kHead + "[bins]\ncount = 201\n", "each with a part of the range"},
        Bad{kHead + "[adaptive]\ndigits = 9\n", "digits: must be from 1 to 6"},
        Bad{kHead + "[adaptive]\n[adaptive.tolerance]\nEYX_um = 0\n", "greater than zero"},
        Bad{kHead + "[adaptive]\n[adaptive.tolerance]\nEXX_um = 1\n", "EXX_um"},
        Bad{kTwo + "[[allocation]]\noutput = \"EBX_urad\"\nlimit = 2\n"
                   "tolerances = [\"probe.A.z_um\"]\n",
            "did you mean \"probe.A.x_um\"?"},
        Bad{kTwo + "[[allocation]]\noutput = \"EBX_urad\"\nlimit = 2\n"
                   "tolerances = [\"probe.A.x_um\", \"probe.A.x_um\"]\n",
            "listed twice"},
        Bad{kTwo + "[[allocation]]\noutput = \"EBX_urad\"\nlimit = -2\n"
                   "tolerances = [\"probe.A.x_um\"]\n",
            "limit: must be greater"},
        Bad{kTwo + "[[allocation]]\noutput = \"EBX_urad\"\nlimit = 2\nprobability = 95\n"
                   "tolerances = [\"probe.A.x_um\"]\n",
            "probability"},
        Bad{kHead + "[compare]\nrig = \"../five-probe/rig_Y.toml\"\n", "same axis"},
        Bad{kHead + "[squareness]\nrig_y = \"../five-probe/rig_X.toml\"\n",
            "axis X (key \"rig\") and a rig of axis Y (key \"rig_y\")"},
        Bad{kHead + "output_of = \"run\"\n[run]\ntargets_mm = [0, 5]\n", "3 to 100 positions"}));

class SampleFile : public testing::Test {
 protected:
  Result<std::vector<double>> load(const std::string& text) {
    std::ofstream(file_) << text;
    auto sample = load_sample(file_);
    std::filesystem::remove(file_);
    return sample;
  }
  const std::string file_ =
      testing::TempDir() + testing::UnitTest::GetInstance()->current_test_info()->name() + ".csv";
};

TEST_F(SampleFile, IsOneColumnWithCommentsAndOptionalHeading) {
  EXPECT_EQ(load("# air\nK\n 3\r\n\n-1.5\n2e0").value(), (std::vector<double>{-1.5, 2, 3}));
}

TEST_F(SampleFile, ErrorsStateTheFault) {
  EXPECT_NE(load("").error().message.find("0 value(s)"), std::string::npos);
  EXPECT_NE(load("5\n").error().message.find("1 value(s)"), std::string::npos);
  EXPECT_NE(load("K\n5\n6,7\n").error().message.find(":3: \"6,7\""), std::string::npos);
  EXPECT_NE(load("5\nnan\n6\n").error().message.find(":2:"), std::string::npos);
}

}  // namespace
}  // namespace mdof
