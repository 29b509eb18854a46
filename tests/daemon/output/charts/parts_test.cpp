// Components of plots: number texts, axes, SVG, colours.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <set>

#include "daemon/output/charts/axis.h"
#include "daemon/output/charts/labels.h"
#include "daemon/output/charts/style.h"
#include "daemon/output/charts/svg.h"
#include "tests/daemon/output/charts/xml_check.h"

namespace mdof::charts {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

std::vector<std::string> labels(const Axis& axis) {
  std::vector<std::string> all;
  for (const Tick& tick : axis.ticks) all.push_back(tick.label);
  return all;
}
using Labels = std::vector<std::string>;

TEST(PlotText, WritesNumbersForPeople) {
  EXPECT_EQ(number_text(0.333333), "0.3333");
  EXPECT_EQ(number_text(-0.5), "−0.5");
  EXPECT_EQ(number_text(1234567.0), "1.235×10⁶");
  EXPECT_EQ(number_text(-3e-12), "−3×10⁻¹²");
  EXPECT_EQ(number_text(-0.0), "0");
  EXPECT_EQ(number_text(kNaN), "–");
  EXPECT_EQ(number_text(5e-324), "4.941×10⁻³²⁴");
  EXPECT_EQ(fixed_text(-0.004, 2), "0.00");
  EXPECT_EQ(fixed_text(-1.5, 1), "−1.5");
  EXPECT_EQ(fixed_text(1e300, 400).size(), 301u + 1 + 340);
  EXPECT_EQ(count_text(0), "0");
  EXPECT_EQ(count_text(1234567), "1\u00a0234\u00a0567");
  EXPECT_EQ(power_text(-23), "10⁻²³");
}

TEST(PlotText, FindsDecimalExponents) {
  EXPECT_EQ(decimal_exponent(1), 0);
  EXPECT_EQ(decimal_exponent(-9.99), 0);
  EXPECT_EQ(decimal_exponent(1000), 3);
  EXPECT_EQ(decimal_exponent(0.00999), -3);
  EXPECT_EQ(decimal_exponent(5e-324), -324);
  EXPECT_EQ(decimal_exponent(0), 0);
  EXPECT_EQ(decimal_exponent(kInf), 0);
  EXPECT_EQ(power_of_ten(-3), 1e-3);
  EXPECT_EQ(power_of_ten(22), 1e22);
}

TEST(PlotText, SeparatesTheUnitFromTheName) {
  EXPECT_EQ(key_label("EAX_urad"), "EAX / µrad");
  EXPECT_EQ(key_label("EYX_um", -3), "EYX / (10⁻³ µm)");
  EXPECT_EQ(key_label("encoder.scale_ppm"), "encoder.scale / ppm");
  EXPECT_EQ(key_label("trials"), "trials");
  EXPECT_EQ(key_label("half_done"), "half_done");
  EXPECT_EQ(key_label("_um"), "_um");
  EXPECT_EQ(key_label("", 6), " / 10⁶");
}

TEST(PlotText, ShortensByCharactersNotBytes) {
  EXPECT_EQ(shortened("µµµµ", 4), "µµµµ");
  EXPECT_EQ(shortened("µµµµµ", 4), "µµµ…");
  EXPECT_EQ(shortened("abc", 1), "…");
  EXPECT_DOUBLE_EQ(text_width("µ", 10), text_width("n", 10));
}

TEST(PlotAxis, HasRoundSteps) {
  EXPECT_EQ(round_step(1), 1);
  EXPECT_EQ(round_step(1.01), 2);
  EXPECT_EQ(round_step(0.21), 0.5);
  EXPECT_EQ(round_step(0.051), 0.1);
  EXPECT_EQ(round_step(6e7), 1e8);
}

TEST(PlotAxis, HasTicksAtRoundNumbers) {
  EXPECT_EQ(labels(horizontal_axis({0, 60, false}, 300)),
            (Labels{"0", "10", "20", "30", "40", "50", "60"}));
  EXPECT_EQ(labels(vertical_axis({-1.05, 1.05, false}, 170)),
            (Labels{"−1.0", "−0.5", "0.0", "0.5", "1.0"}));
  const Axis tenths = vertical_axis({0, 0.35, false}, 150);
  EXPECT_EQ(labels(tenths), (Labels{"0.0", "0.1", "0.2", "0.3"}));
  EXPECT_EQ(tenths.ticks[3].at, 0.3);
}

TEST(PlotAxis, APowerOfTenIsRemovedFromSmallAndLargeLabels) {
  const Axis small = vertical_axis({0, 4e-8, false}, 150);
  EXPECT_EQ(small.exponent, -9);
  EXPECT_EQ(labels(small), (Labels{"0", "10", "20", "30", "40"}));
  const Axis large = vertical_axis({0, 2e6, false}, 150);
  EXPECT_EQ(large.exponent, 6);
  EXPECT_EQ(labels(large), (Labels{"0.0", "0.5", "1.0", "1.5", "2.0"}));
}

TEST(PlotAxis, HasAscendingLimitsAndTicksForAnyRange) {
  for (const auto& [low, high] : {std::pair{-kInf, kInf},
                                  {kNaN, kNaN},
                                  {5.0, 5.0},
                                  {0.0, 0.0},
                                  {-1.7e308, 1.7e308},
                                  {0.0, 5e-324},
                                  {1e9, 1e9 + 1e-3},
                                  {1.0, 1.0 + 1e-15},
                                  {-3e-300, 8e-300},
                                  {1e-300, 1e300}}) {
    Range range;
    range.include(low);
    range.include(high);
    for (const Axis& axis : {horizontal_axis(padded(range, 0.02), 300),
                             vertical_axis(padded(range, 0.02), 150), vertical_axis(range, 150)}) {
      EXPECT_LT(axis.low, axis.high);
      EXPECT_GE(axis.ticks.size(), 1u) << low << " " << high;
      EXPECT_LE(axis.ticks.size(), 12u) << low << " " << high;
      std::set<std::string> different;
      for (const Tick& tick : axis.ticks) different.insert(tick.label);
      EXPECT_EQ(different.size(), axis.ticks.size()) << low << " " << high;
      for (const double x : {low, high, 0.0, kNaN})
        EXPECT_TRUE(axis.fraction(x) >= 0 && axis.fraction(x) <= 1) << x;
    }
  }
}

// Smallest distance in px between two neighbouring labels of an axis.
double least_gap(const Axis& axis, double length_px) {
  double least = length_px;
  for (std::size_t i = 1; i < axis.ticks.size(); ++i) {
    const Tick &a = axis.ticks[i - 1], &b = axis.ticks[i];
    const double widths = text_width(a.label, kTickPx) + text_width(b.label, kTickPx);
    least = std::min(least, (axis.fraction(b.at) - axis.fraction(a.at)) * length_px - widths / 2);
  }
  return least;
}

TEST(PlotAxis, LabelsDoNotTouch) {
  for (const double length : {60.0, 100.0, 323.0, 700.0})
    for (const double high : {1.0, 7.3, 60.0, 1e4, 12345.0, 3e-7, 1e150}) {
      EXPECT_GT(least_gap(horizontal_axis({-high / 3, high, false}, length), length), 0) << high;
      const Range decades{std::min(high / 3, 1.0), high, false};
      EXPECT_GT(least_gap(logarithmic_axis(decades, length), length), 0) << length << " " << high;
    }
}

TEST(PlotAxis, IsLogarithmicToTheHundredthOfAPixel) {
  const Axis axis = logarithmic_axis({1e4, 1e8, false}, 320);
  EXPECT_EQ(labels(axis), (Labels{"10⁴", "10⁵", "10⁶", "10⁷", "10⁸"}));
  for (const double x : {1e4, 3.3e4, 1e6, 7.77e7, 1e8})
    EXPECT_NEAR(axis.fraction(x), (std::log10(x) - 4) / 4, 1e-9) << x;
  EXPECT_EQ(axis.fraction(1), 0);
  EXPECT_EQ(axis.fraction(1e9), 1);
  EXPECT_EQ(labels(logarithmic_axis({3e4, 2e5, false}, 700)), (Labels{"5×10⁴", "10⁵", "2×10⁵"}));
  EXPECT_EQ(labels(logarithmic_axis({10'240, 1e6, false}, 316)),
            (Labels{"2×10⁴", "5×10⁴", "10⁵", "2×10⁵", "5×10⁵", "10⁶"}));
}

TEST(PlotAxis, ASingleNumberOfTrialsIsInTheMiddle) {
  const Axis axis = logarithmic_axis({1e6, 1e6, false}, 320);
  EXPECT_NEAR(axis.fraction(1e6), 0.5, 1e-9);
  EXPECT_EQ(logarithmic_axis({0, 0, false}, 320).fraction(kNaN), 0);
}

TEST(PlotSvg, EscapesCharactersThatXmlForbids) {
  EXPECT_EQ(xml_escaped("a<b>&\"'µ"), "a&lt;b&gt;&amp;&quot;&#39;µ");
  EXPECT_EQ(xml_escaped(std::string_view("a\0b\x1b", 4)),
            "a\xef\xbf\xbd"
            "b\xef\xbf\xbd");
  EXPECT_EQ(xml_escaped("a\nb\tc"), "a b c");
  EXPECT_EQ(xml_escaped("x\xff<"), "x\xef\xbf\xbd&lt;");
  EXPECT_EQ(xml_escaped("\xef\xbf\xbe.\xef\xbf\xbf"), "\xef\xbf\xbd.\xef\xbf\xbd");
}

TEST(PlotSvg, IsWellFormedAndHasRoundCoordinates) {
  Svg svg(10, 20, "<t>", "]]>&");
  svg.begin_group("\"");
  svg.line("ink", {1.0 / 3, -0.001}, {kNaN, 1e300});
  svg.end_group();
  const std::string text = svg.take();
  EXPECT_EQ(xml_fault(text), "");
  EXPECT_NE(text.find("<line class=\"ink\" x1=\"0.33\" y1=\"0\" x2=\"0\" y2=\"100000\"/>"),
            std::string::npos);
  EXPECT_EQ(text.find("http", text.find("xmlns") + 40), std::string::npos);
}

// The check of XML must find faults.
TEST(PlotSvg, TheXmlCheckFindsFaults) {
  const std::string head = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  EXPECT_EQ(xml_fault(head + "<svg a=\"1\"><g>x</g></svg>\n"), "");
  for (const char* bad :
       {"<svg a=\"1\"><g></svg>\n", "<svg a=\"1\">&nbsp;</svg>\n", "<svg a=\"1\" a=\"2\"></svg>\n",
        "<svg a=\"<\"></svg>\n", "<svg a=\"1\">\x01</svg>\n", "<svg a=\"1\"></svg>\n<svg/>",
        "<svg a=\"1\"><g a=1></g></svg>\n", "<svg a=\"1\"><g>", "\xff"})
    EXPECT_NE(xml_fault(head + bad), "") << bad;
}

double channel(const char* colour, int at) {
  const std::string hex(colour + at, 2);
  const double c = static_cast<double>(std::strtol(hex.c_str(), nullptr, 16)) / 255;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

double luminance(const char* colour) {
  return 0.2126 * channel(colour, 1) + 0.7152 * channel(colour, 3) + 0.0722 * channel(colour, 5);
}

// Contrast ratio as defined in WCAG 2.1.
double contrast(const char* a, const char* b) {
  const auto [low, high] = std::minmax({luminance(a), luminance(b)});
  return (high + 0.05) / (low + 0.05);
}

const Colour& paper() {
  return *std::find_if(colours().begin(), colours().end(),
                       [](const Colour& c) { return c.mark == std::string_view("paper"); });
}

TEST(PlotStyle, ColoursHaveTheStatedContrastInLightAndDark) {
  EXPECT_NEAR(contrast("#ffffff", "#000000"), 21, 1e-9);
  const std::set<std::string_view> texts = {"text", "quiet"};
  const std::set<std::string_view> no_data = {"paper", "halo", "grid"};
  for (const Colour& c : colours()) {
    const bool fill_with_outline =
        c.property == std::string_view("fill") &&
        (c.mark == std::string_view("wide") || c.mark == std::string_view("narrow"));
    if (no_data.contains(c.mark) || fill_with_outline) continue;
    const double least = texts.contains(c.mark) ? 4.5 : 3;
    EXPECT_GE(contrast(c.light, paper().light), least) << c.mark;
    EXPECT_GE(contrast(c.dark, paper().dark), least) << c.mark;
  }
}

TEST(PlotStyle, DefinesBothColoursOfEveryMark) {
  const std::string css = style_sheet();
  const std::size_t dark = css.find("@media (prefers-color-scheme:dark){");
  ASSERT_NE(dark, std::string::npos);
  for (const Colour& c : colours()) {
    const std::string rule = std::string(".") + c.mark + "{" + c.property + ":";
    EXPECT_LT(css.find(rule + c.light), dark) << c.mark;
    EXPECT_NE(css.find(rule + c.dark, dark), std::string::npos) << c.mark;
  }
}

}  // namespace
}  // namespace mdof::charts
