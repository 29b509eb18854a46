#include "schema/machine/machine.h"

#include <gtest/gtest.h>

#include <array>

namespace mdof {
namespace {

const std::string kMachine = R"(name = "grooving machine"
machine = {chain = "w-C-Y-b-X-Z-t", travel = {Y = "-"}}
tool = {point_mm = [0, 0, 120]}
[[axis]]
id = "X"
holds_at_mm = [0, 0, 120]
point = "moving"
range_mm = [0, 400]
EXX_um = [[0, 0, 0.5], [400, 8, 9]]
u_EXX_um = 0.2
EYX_file = "eyx.csv"
EAX_urad = 3
[[axis]]
id = "Y"
holds_at_mm = [1, 2, 3]
point = "standing"
file = "y.csv"
EC0Y_urad = 25
u_EC0Y_urad = 0.4
[[axis]]
id = "Z"
holds_at_mm = [0, 0, 0]
point = "moving"
[[axis]]
id = "C"
centre_mm = [200, 200, 0]
EXC_um = [[0, 0], [360, 1]]
EX0C_um = 2
EA0C_urad = -4
)";
const std::string kColumn =
    "[[frame]]\nid = \"column\"\nafter = \"b\"\nholds_at_mm = [0, 0, 500]\nEC_urad = 5\nu_EC_urad "
    "= 1\n";

TEST(MachineToml, IsRead) {
  const auto read = parse_machine(kMachine + kColumn, "m.toml");
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->frames.size(), 5u);
  EXPECT_EQ(read->frames[2].id, "column");
  EXPECT_FALSE(read->frames[2].carries_work);
  EXPECT_EQ(error_name(read->frames[2], 5), "EC(column)");
  EXPECT_DOUBLE_EQ(read->frames[2].error[5].forward[0], 5e-6);
  const auto* x = read->find("X");
  EXPECT_EQ(x->error[0].position, (std::vector<double>{0, 0.4}));
  ASSERT_EQ(x->error[0].reverse.size(), 2u);
  EXPECT_DOUBLE_EQ(x->error[0].reverse[1], 9e-6);
  ASSERT_EQ(x->error[0].u.size(), 2u);
  EXPECT_DOUBLE_EQ(x->error[0].u[1], 0.2e-6);
  EXPECT_EQ(x->error[1].file, "eyx.csv");
  EXPECT_TRUE(x->point_moves && !x->carries_work);
  const auto* y = read->find("Y");
  EXPECT_TRUE(y->carries_work && y->against_command && !y->point_moves);
  EXPECT_DOUBLE_EQ(*y->location[5].value, 25e-6);
  EXPECT_DOUBLE_EQ(*y->location[5].u, 0.4e-6);
  const auto* c = read->find("C");
  EXPECT_NEAR(c->error[0].position[1], 6.283185307179586, 1e-15);
  EXPECT_DOUBLE_EQ(*c->location[3].value, -4e-6);
  EXPECT_DOUBLE_EQ(read->tool_m[2], 0.12);
}

// The key `after` names a link. A fixed frame follows this link and belongs to the same side of
// the chain.
TEST(MachineToml, ReadsFixedFramesInTheirOrder) {
  const auto frame = [](const char* id, const char* after) {
    return "[[frame]]\nid = \"" + std::string(id) + "\"\nafter = \"" + after +
           "\"\nholds_at_mm = [0, 0, 0]\n";
  };
  const auto read =
      parse_machine(kMachine + frame("fixture", "w") + frame("saddle", "Y") + frame("column", "b") +
                        frame("spindle", "Z") + frame("holder", "spindle"),
                    "m.toml");
  ASSERT_TRUE(read) << read.error().message;
  std::string order;
  for (const auto& f : read->frames) order += f.id + (f.carries_work ? "w " : "t ");
  EXPECT_EQ(order, "fixturew Cw Yw saddlew columnt Xt Zt spindlet holdert ");
}

const std::string kRod =
    "[[frame]]\nid = \"rod\"\nafter = \"b\"\nwith = \"Y\"\nalong = \"X\"\nratio = 2.0649\n"
    "holds_at_mm = [0, 0, 0]\n";
const std::string kScrew = R"toml([[source]]
name = "screw"
u = 0.3
unit = "um"
distribution = "rectangular"
acts_on = [{error = "EX(rod)", factor = -1},
           {error = "EYY", factor = 0.5, factor_per_mm = -2, of = "X"},
           {error = "EC0Y", factor_per_deg = 3, of = "C"}]
)toml";

TEST(MachineToml, ReadsAMovingBodyAndASource) {
  const auto read = parse_machine(kMachine + kRod + kScrew, "m.toml");
  ASSERT_TRUE(read) << read.error().message;
  const auto* rod = read->find("rod");
  ASSERT_TRUE(rod);
  EXPECT_TRUE(moves_along(*rod) && rod->point_moves && !rod->carries_work);
  EXPECT_EQ(rod->moves_with, 'Y');
  EXPECT_EQ(rod->direction, 0u);
  EXPECT_EQ(rod->ratio, 2.0649);
  ASSERT_EQ(read->sources.size(), 1u);
  const ErrorSource& screw = read->sources[0];
  EXPECT_EQ(screw.shape, SourceShape::rectangular);
  EXPECT_EQ(screw.u, 0.3);
  ASSERT_EQ(screw.acts_on.size(), 3u);
  EXPECT_EQ(&read->frames[screw.acts_on[0].frame], rod);
  EXPECT_DOUBLE_EQ(screw.acts_on[0].factor, -1e-6);
  EXPECT_EQ(screw.acts_on[1].k, 1u);
  EXPECT_DOUBLE_EQ(screw.acts_on[1].factor, 0.5e-6);
  EXPECT_DOUBLE_EQ(screw.acts_on[1].factor_per_position, -2e-3);
  EXPECT_TRUE(screw.acts_on[2].of_line);
  EXPECT_NEAR(screw.acts_on[2].factor_per_position, 3e-6 * 180 / 3.141592653589793, 1e-18);
}

// Table 1 of the paper on the co-planar machine has 14 joints with six part errors each.
TEST(MachineToml, CoPlanarMachineHas84PartErrors) {
  const auto read = parse_machine(co_planar_machine(), "co-planar");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->frames.size() * kBodyErrors, 84u);
  EXPECT_EQ(read->sources.size(), 6u);
}

struct Bad {
  const char *from, *to, *says;
};
TEST(MachineToml, ErrorsNameTheInvalidKey) {
  const Bad all[] = {
      {"point = \"moving\"\nrange", "range", "point"},
      {"point = \"moving\"\nrange", "point = \"still\"\nrange", "standing"},
      {"EXX_um = [[0, 0, 0.5]", "EXX_um = [[500, 0, 0.5]", "increase"},
      {"[400, 8, 9]", "[400, nan, 9]", "finite"},
      {"[400, 8, 9]", "[400, 8]", "all rows"},
      {"[400, 8, 9]", "[400, 80000, 9]", "unit"},
      {"EAX_urad = 3", "EAX_urad = 3e6", "unit"},
      {"EAX_urad = 3", "EAX_um = 3", "EAX_u"},
      {"EC0Y_urad", "EC0X_urad", "EC0"},
      {"EAX_urad = 3", "EC0X_urad = 3",
       "axis[2].EC0Y_urad: the angle between the axes X and Y is given twice: EC0Y is the same "
       "angle as EC0X"},
      {"u_EC0Y_urad = 0.4", "u_EC0Y_urad = -1", "from 0 to 100000, not -1"},
      {"u_EC0Y_urad = 0.4", "u_EC0Y_urad = 1e300", "u_EC0Y_urad: must be"},
      {"u_EXX_um = 0.2", "u_EXX_um = 10001", "from 0 to 10000, not 10001"},
      {"range_mm = [0, 400]", "angles_zero_at_mm = 0",
       "axis[1].angles_zero_at_mm: applies only to"},
      {"centre_mm = [200, 200, 0]\n", "", "centre_mm"},
      {"id = \"Z\"", "id = \"Y\"", "twice"},
      {"id = \"Z\"", "id = \"B\"", "has no axis"},
      {"[0, 400]", "[400, 0]", "the second must be greater than the first"},
      {"w-C-Y-b-X-Z-t", "w-C-Y-X-Z-t", "bed"},
      {"holds_at_mm = [1, 2, 3]", "holds_at_mm = [1, 2, inf]", "holds_at_mm"},
      {"name", "nam", "nam"},
      {"with = \"Y\"", "with = \"C\"", "frame[1].with"},
      {"along = \"X\"", "along = \"A\"", "frame[1].along"},
      {"ratio = 2.0649", "ratio = 0", "frame[1].ratio"},
      {"ratio = 2.0649", "ratio = nan", "frame[1].ratio"},
      {"ratio = 2.0649", "ratios = 2", "ratio"},
      {"\"EYY\"", "\"EYQ\"", "did you mean"},
      {"factor = -1", "factor = inf", "acts_on[1].factor"},
      {"factor = -1", "factors = 1", "factor"},
      {"of = \"X\"", "of = \"rod\"", "acts_on[2].of"},
      {"u = 0.3", "u = -0.3", "source[1].u"},
      {"u = 0.3", "u = nan", "source[1].u"},
      {"\"rectangular\"", "\"square\"", "source[1].distribution"},
      {"\"screw\"", "\"EXX\"", "source[1].name"},
      {"unit = \"um\"", "units = \"um\"", "unit"},
  };
  for (const Bad& bad : all) {
    std::string text = kMachine + kRod + kScrew;
    const auto at = text.find(bad.from);
    ASSERT_NE(at, std::string::npos) << bad.from;
    text.replace(at, std::string(bad.from).size(), bad.to);
    const auto read = parse_machine(text, "m.toml");
    ASSERT_FALSE(read) << bad.from << " -> " << bad.to;
    EXPECT_NE(read.error().message.find(bad.says), std::string::npos) << read.error().message;
    EXPECT_NE(read.error().message.find("m.toml"), std::string::npos) << read.error().message;
  }
}

// Without a chain, the machine has no errors that a source could act on.
TEST(MachineToml, WithoutAValidChainOnlyTheChainIsReported) {
  const std::string source =
      "[[source]]\nname = \"s\"\nu = 1\nunit = \"um\"\nacts_on = [{error = \"EBX\", factor = 1}]\n";
  const auto malformed =
      parse_machine("name = \"d\"\n[machine]\nchain = \"w-X-b\"\n" + source, "m.toml");
  ASSERT_FALSE(malformed);
  EXPECT_NE(malformed.error().message.find("\"w-X-b\" is not a kinematic chain"), std::string::npos)
      << malformed.error().message;
  const auto missing = parse_machine("name = \"d\"\n" + source, "m.toml");
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().message.find("chain is missing"), std::string::npos)
      << missing.error().message;
}

// A file may lack u, so u can be declared. Runs and tables have their own u.
TEST(MachineToml, UncertaintyCompletesAFileButNotRuns) {
  const auto with = [](const std::string& keys) {
    return parse_machine(
        "name = \"m\"\nmachine = {chain = \"w-b-X-t\"}\n[[axis]]\nid = \"X\"\n"
        "holds_at_mm = [0, 0, 0]\npoint = \"moving\"\nu_EYX_um = 0.2\n" +
            keys,
        "m.toml");
  };
  const auto file = with("file = \"x.csv\"\n");
  ASSERT_TRUE(file) << file.error().message;
  ASSERT_EQ(file->find("X")->error[1].u.size(), 1u);
  EXPECT_DOUBLE_EQ(file->find("X")->error[1].u[0], 0.2e-6);
  for (const char* rows : {"runs = [1]\n", "tables = [1]\n"}) {
    const auto stored = with(rows);
    ASSERT_FALSE(stored);
    EXPECT_NE(stored.error().message.find("already have an uncertainty"), std::string::npos)
        << stored.error().message;
  }
  EXPECT_NE(with("").error().message.find("u_EYX_um: unknown key"), std::string::npos);
}

TEST(MachineToml, ReadsNumbersOfRunsTablesAndSquareness) {
  const auto named = [](const std::string& root, const std::string& of_axis) {
    return parse_machine(root +
                             "name = \"m\"\nmachine = {chain = \"w-b-X-t\"}\n[[axis]]\nid = \"X\"\n"
                             "holds_at_mm = [0, 0, 0]\npoint = \"moving\"\n" +
                             of_axis,
                         "m.toml");
  };
  const auto none = named("", "");
  EXPECT_FALSE(none->names_stored_rows());
  const auto numbers = named("squareness = 7\n", "runs = [3, 5]\ntables = 4\n");
  ASSERT_TRUE(numbers) << numbers.error().message;
  EXPECT_TRUE(numbers->names_stored_rows());
  EXPECT_EQ(numbers->squareness.ids, std::vector<std::int64_t>{7});
  EXPECT_EQ(numbers->find("X")->runs.ids, (std::vector<std::int64_t>{3, 5}));
  EXPECT_EQ(numbers->find("X")->tables.ids, std::vector<std::int64_t>{4});
  EXPECT_FALSE(numbers->find("X")->runs.latest);
  const auto latest = named("squareness = \"latest\"\n", "runs = \"latest\"\n");
  EXPECT_TRUE(latest->squareness.latest && latest->find("X")->runs.latest);
  EXPECT_TRUE(named("squareness = 1\n", "")->names_stored_rows());
  EXPECT_TRUE(named("", "tables = [1]\n")->names_stored_rows());
  for (const auto& [root, of_axis, says] : {std::array{"", "runs = \"newest\"\n", "latest"},
                                            {"", "runs = [0]\n", "1 or greater"},
                                            {"", "runs = [1.5]\n", "1 or greater"},
                                            {"", "runs = []\n", "empty"},
                                            {"", "runs = true\n", "number"},
                                            {"", "tables = \"latest\"\n", "numbers of tables"},
                                            {"squareness = [1, 2, 3, 4]\n", "", "at most three"}}) {
    const auto refused = named(root, of_axis);
    ASSERT_FALSE(refused) << of_axis;
    EXPECT_NE(refused.error().message.find(says), std::string::npos) << refused.error().message;
  }
}

}  // namespace
}  // namespace mdof
