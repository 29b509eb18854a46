// Plots of an artificial study. Known values are drawn correctly. The files are valid XML for any
// figures. Equal figures give equal bytes.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>

#include "daemon/output/charts/study/study_plots.h"
#include "schema/base/sha256.h"
#include "tests/daemon/output/charts/xml_check.h"

namespace mdof {
namespace {

namespace fs = std::filesystem;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

// An output with a triangular density over [-half, half] and rounded statistics. Its calculation
// needs no random numbers and no functions that depend on the machine. Therefore the bytes of its
// plots are known in advance.
OutputSummary triangular(std::string key, double half) {
  OutputSummary o;
  o.key = std::move(key);
  o.n = 0;
  o.histogram = {-half, half / 30, {}, 0, 0};
  for (std::uint64_t i = 0; i < 60; ++i) {
    o.histogram.counts.push_back(100 * (i < 30 ? i + 1 : 60 - i));
    o.n += o.histogram.counts.back();
  }
  o.mean = half / 64;
  o.sd = 0.4082 * half;
  o.min = -0.99 * half;
  o.max = 0.985 * half;
  o.symmetric = {-0.7764 * half, 0.7764 * half};
  o.shortest = {-0.75 * half, 0.8 * half};
  return o;
}

std::vector<StudyBin> bins_of(const std::vector<OutputSummary>& outputs, int n) {
  std::vector<StudyBin> bins;
  for (int i = 0; i < n; ++i) {
    StudyBin bin{3.0 * i, 3.0 * (i + 1), {}};
    for (std::size_t k = 0; k < outputs.size(); ++k) {
      // displacements (k < 2) increase with the travel, angles do not
      const double half = (k < 2 ? 0.2 + 0.8 * i / n : 1.0) * -outputs[k].histogram.from;
      bin.outputs.push_back(triangular(outputs[k].key, half));
    }
    bins.push_back(bin);
  }
  return bins;
}

Convergence converging(const OutputSummary& o) {
  Convergence c{o.key, {}};
  double off = 0.25;
  for (std::uint64_t trials = 10'000; trials <= 100'000'000; trials *= 10) {
    c.points.push_back({trials, o.mean + off * o.sd, o.sd * (1 - off / 2),
                        o.symmetric.low + off * o.sd / 3, o.symmetric.high - off * o.sd});
    off *= -0.31;
  }
  return c;
}

StudyResult study() {
  StudyResult r;
  r.name = "simulation-1";
  r.seed = 1;
  r.trials = r.trials_wanted = 100'000'000;
  for (const auto& [key, half] : {std::pair{"EYX_um", 0.085},
                                  {"EZX_um", 0.055},
                                  {"EAX_urad", 1.0},
                                  {"EBX_urad", 1.0},
                                  {"ECX_urad", 1.0}})
    r.outputs.push_back(triangular(key, half));
  r.binned_key = "travel_mm";
  r.bins = bins_of(r.outputs, 20);
  for (const OutputSummary& o : r.outputs) r.convergence.push_back(converging(o));
  r.indices = {{"EAX_urad",
                {{"probe.A.position_um", 0.412, 0.004, 0.455, 0.006},
                 {"temperature.fixture_K", 0.308, 0.004, 0.31, 0.005},
                 {"noise", 0.2, 0.003, 0.231, 0.004},
                 {"encoder.scale_ppm", -0.002, 0.003, 0.001, 0.002}}},
               {"EYX_um", {{"noise", 0.96, 0.01, 1.02, 0.012}}}};
  Allocation a;
  a.output = "EBX_urad";
  a.limit = 2;
  a.probability = 0.95;
  for (int i = 0; i <= 6; ++i) {
    const double x = 2.0 * i, y = (144 - x * x) / 16;
    a.frontier.push_back(
        {{"probe.*.position_um", x, x, x}, {"fixture.pitch_mrad", y, y - 0.4, y + 0.3}});
  }
  r.allocations = {a};
  return r;
}

class Plots : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() /
              ("mdof_plot_test_" +
               std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  // Writes the plots and returns the text of each file by its name. Each file must be well-formed
  // and must not contain NaN or infinity.
  std::map<std::string, std::string> write(const StudyResult& result) {
    const Status written = charts::write_study_plots(result, folder_);
    EXPECT_TRUE(written) << written.error().message;
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::directory_iterator(folder_)) {
      std::ifstream in(entry.path(), std::ios::binary);
      const std::string text(std::istreambuf_iterator<char>(in), {});
      EXPECT_EQ(xml_fault(text), "") << entry.path();
      for (const char* bad : {"\"nan", "\"-nan", "\"inf", "\"-inf", ",nan", ",inf"})
        EXPECT_EQ(text.find(bad), std::string::npos) << entry.path() << " has " << bad;
      files[entry.path().filename().string()] = text;
    }
    return files;
  }
  fs::path folder_;
};

std::set<std::string> names(const std::map<std::string, std::string>& files) {
  std::set<std::string> all;
  for (const auto& [name, text] : files) all.insert(name);
  return all;
}

TEST_F(Plots, AreOneFileForEachFigure) {
  EXPECT_EQ(names(write(study())),
            (std::set<std::string>{"histogram-EYX_um.svg", "histogram-EZX_um.svg",
                                   "histogram-EAX_urad.svg", "histogram-EBX_urad.svg",
                                   "histogram-ECX_urad.svg", "error-against-travel.svg",
                                   "sensitivity.svg", "convergence.svg", "allocation.svg"}));
}

TEST_F(Plots, AreNotWrittenForMissingFigures) {
  StudyResult r;
  EXPECT_TRUE(write(r).empty());
  r.outputs = {triangular("EAX_urad", 1)};
  EXPECT_EQ(names(write(r)), (std::set<std::string>{"histogram-EAX_urad.svg"}));
}

// SHA-256 of the names and texts of all files, in the order of the names.
std::string hash(const std::map<std::string, std::string>& files) {
  Sha256 hash;
  for (const auto& [name, text] : files) hash.update(name + '\n' + text);
  return hash.hex();
}

TEST_F(Plots, AreTheSameBytesInEveryBuild) {
  EXPECT_EQ(hash(write(study())),
            "6b0168847ad8aa9702efb607293dd00341d1f4026954e735cb141b7d0ba621e3");
}

TEST_F(Plots, DoNotDependOnTimeOrFolder) {
  StudyResult r = study();
  const auto before = write(r);
  r.started_utc = "2025-01-01T00:00:00Z";
  r.elapsed_s = 12.5;
  r.software = "9.9.9";
  EXPECT_EQ(write(r), before);
}

TEST_F(Plots, ShowTheNumbersOfTheStudy) {
  const auto files = write(study());
  const auto has = [&](const std::string& file, const std::string& text) {
    return files.at(file).find(">" + text + "<") != std::string::npos;
  };
  EXPECT_TRUE(has("histogram-EAX_urad.svg", "EAX / µrad"));
  EXPECT_TRUE(has("histogram-EAX_urad.svg", "0.01562 ± 0.4082"));
  EXPECT_TRUE(has("histogram-EAX_urad.svg", "[−0.7764, 0.7764]"));
  EXPECT_TRUE(has("histogram-EAX_urad.svg", "shortest 95\u00a0%"));
  EXPECT_TRUE(has("error-against-travel.svg", "travel / mm"));
  EXPECT_TRUE(has("sensitivity.svg", "0.412 ± 0.004"));
  EXPECT_TRUE(has("allocation.svg", "permitted if P(|EBX| ≤ 2\u00a0µrad) ≥ 95\u00a0%"));
  EXPECT_TRUE(has("convergence.svg", "10⁸"));
}

TEST_F(Plots, StateThatAStudyWasInterrupted) {
  StudyResult r = study();
  r.state = StudyState::interrupted;
  r.trials = 300'000;
  EXPECT_NE(write(r).at("convergence.svg").find("300\u00a0000 trials, seed 1; interrupted"),
            std::string::npos);
}

TEST_F(Plots, AreValidForAnyText) {
  StudyResult r = study();
  r.name = "<b>&\"'" + std::string(1, '\x02') + std::string(300, 'n');
  r.outputs[0].key = "../a b/ä_um";
  r.outputs[1].key = std::string(80, 'k') + "_um";
  r.convergence[0].key = "\xff\xfe_um";
  r.indices[0].causes[0].cause = "<" + std::string(200, 'c');
  const auto files = write(r);
  EXPECT_TRUE(files.contains("histogram-..%2fa%20b%2f%c3%a4_um.svg"));
  EXPECT_EQ(files.size(), 9u);
}

// Each number of the study is replaced by extreme numbers.
TEST_F(Plots, AreValidForExtremeFigures) {
  for (const double x : {0.0, 1e-320, 1e-12, 1e9, 1.7e308, -1.7e308, kNaN, kInf}) {
    StudyResult r = study();
    OutputSummary& o = r.outputs[0];
    o.mean = o.sd = o.min = o.max = o.symmetric.low = o.symmetric.high = x;
    o.shortest = {-x, x};
    r.outputs[1].histogram.from = std::isfinite(x) ? x : 0;
    r.outputs[1].histogram.width = std::abs(x);
    r.outputs[2].n = 0;
    for (StudyBin& bin : r.bins) bin.outputs[0] = o;
    r.bins[3].outputs[1].max = x;
    r.bins[5].outputs[1].n = 0;
    r.bins[6].outputs.clear();
    r.convergence[0].points = {{0, x, x, -x, x}};
    r.convergence[1].points.back().mean = x;
    r.indices[0].causes[0] = {"x", x, x, -x, x};
    r.allocations[0].frontier[0][1].value = x;
    r.allocations[0].frontier[1][1].high = x;
    r.allocations[0].frontier[2].clear();
    EXPECT_EQ(write(r).size(), 8u) << x;
    fs::remove_all(folder_);
  }
}

TEST_F(Plots, TheLegendNamesOnlyIntervalsThatAreDrawn) {
  StudyResult r = study();
  const auto names_intervals = [&] {
    for (const auto& [name, text] : write(r))
      if (name == "allocation.svg") return text.find("sampling uncertainty") != text.npos;
    throw std::runtime_error("no frontier is drawn");
  };
  EXPECT_TRUE(names_intervals());
  for (auto& pair : r.allocations[0].frontier) pair[1].low = pair[1].high = kNaN;
  EXPECT_FALSE(names_intervals());
}

TEST_F(Plots, AConstantOutputHasOneBar) {
  StudyResult r;
  OutputSummary o = triangular("EAX_urad", 1);
  o.histogram = {2.5, 0, {1000}, 0, 0};
  o.n = 1000;
  o.mean = o.min = o.max = 2.5;
  o.sd = 0;
  o.symmetric = o.shortest = {2.5, 2.5};
  r.outputs = {o};
  const std::string text = write(r).at("histogram-EAX_urad.svg");
  EXPECT_NE(text.find(">2.5 ± 0<"), std::string::npos);
  EXPECT_NE(text.find(">2.50<"), std::string::npos);  // the tick under the bar
}

TEST_F(Plots, ShowTheLargestOfManyCausesAndCountTheOthers) {
  StudyResult r;
  r.indices = {{"EAX_urad", {}}};
  for (int i = 0; i < 50; ++i)
    r.indices[0].causes.push_back({"cause " + std::to_string(i), 0.02, 0, 0.5 / (i + 1), 0});
  const std::string text = write(r).at("sensitivity.svg");
  EXPECT_NE(text.find(">cause 19<"), std::string::npos);
  EXPECT_EQ(text.find(">cause 20<"), std::string::npos);
  EXPECT_NE(text.find(">30 more causes, each with a total index of at most 0.024<"),
            std::string::npos);
}

TEST_F(Plots, StateThatExtremesAreCutOff) {
  StudyResult r = study();
  constexpr const char* kNote =
      "An extreme value outside the range of a panel is drawn at the edge of that panel.";
  EXPECT_EQ(write(r).at("error-against-travel.svg").find(kNote), std::string::npos);
  r.bins[0].outputs[0].max = 1e6;
  EXPECT_NE(write(r).at("error-against-travel.svg").find(kNote), std::string::npos);
}

TEST_F(Plots, NeedAWritableFolder) {
  const Status in_a_file = charts::write_study_plots(study(), "/dev/null/plots");
  ASSERT_FALSE(in_a_file);
  EXPECT_EQ(in_a_file.error().code, ErrorCode::io);
  EXPECT_NE(in_a_file.error().message.find("/dev/null/plots: cannot create"), std::string::npos);
  EXPECT_NE(in_a_file.error().message.find("give another folder"), std::string::npos);
  fs::create_directories(folder_ / "histogram-EYX_um.svg" / "full");
  const Status no_file = charts::write_study_plots(study(), folder_);
  ASSERT_FALSE(no_file);
  EXPECT_NE(no_file.error().message.find("histogram-EYX_um.svg: cannot be written"),
            std::string::npos);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);  // no incomplete file remains
}

}  // namespace
}  // namespace mdof
