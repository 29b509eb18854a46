#include "schema/field/shape.h"

#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "schema/field/field.h"

namespace mdof {
namespace {

TEST(FieldNames, EachHasOneRowAndAMeaning) {
  std::set<std::string_view> seen;
  for (const Field& row : fields()) {
    EXPECT_TRUE(seen.insert(row.name).second) << row.name;
    EXPECT_FALSE(row.meaning.empty()) << row.name;
    EXPECT_FALSE(row.meaning.ends_with('.')) << row.name;
    EXPECT_EQ(find_field(row.name)->row, &row) << row.name;
    json_schema(row.type);  // json_schema() must be able to read each type
  }
}

TEST(FieldNames, NamesAreFoundByTheirPatterns) {
  EXPECT_EQ(find_field("EYX_um")->row->name, "E{linear}{axis}_um");
  EXPECT_EQ(find_field("EBC_urad")->row->name, "E{angular}{axis}_urad");
  EXPECT_EQ(find_field("EC0Y_urad")->row->name, "E{angular}0{axis}_urad");
  EXPECT_EQ(find_field("run_y")->row->name, "run_{small}");
  for (const char* unknown :
       {"EYX_mm", "ECX_um", "EY_um", "EYXX_um", "run_q", "u_", "u_none", "", "{none}"})
    EXPECT_FALSE(find_field(unknown)) << unknown;
}

TEST(FieldNames, UncertaintyRefersToAnotherRow) {
  const auto u = find_field("u_random_EC0Y_urad");
  ASSERT_TRUE(u);
  EXPECT_EQ(u->row->name, "u_random_{field}");
  EXPECT_NE(u->meaning.find("EC0Y_urad"), std::string::npos) << u->meaning;
  EXPECT_EQ(find_field("u_covers")->row->name, "u_covers");  // this member has its own row
}

TEST(FieldNames, RegularExpressionsMatchTheirFields) {
  const std::regex error(field_regex("u_E{linear}{axis}_um"));
  EXPECT_TRUE(std::regex_match("u_EYX_um", error));
  EXPECT_FALSE(std::regex_match("u_ECX_um", error));
  EXPECT_FALSE(std::regex_match("EYX_um", error));
}

// The expected texts were written by hand from the rules of JSON Schema.
TEST(Shape, IsConvertedToAJsonSchema) {
  EXPECT_EQ(
      json_schema("{active, scans_lost?}"),
      R"({"type":"object","properties":{"active":{"type":"boolean","description":"true: the table is active"},)"
      R"("scans_lost":{"type":["integer","null"],"description":"number of scans that are missing; null: )"
      R"(the scans of the log are not numbered, or the end of the run was not stored"}},"required":["active"],"additionalProperties":false})");
  EXPECT_EQ(json_schema("{}"), R"({"type":"object","additionalProperties":false})");
  EXPECT_EQ(json_schema("[[number|null]]"),
            R"({"type":"array","items":{"type":"array","items":{"type":["number","null"]}}})");
  EXPECT_EQ(json_schema("{*: number}"),
            R"({"type":"object","additionalProperties":{"type":"number"}})");
}

TEST(Shape, MemberThatIsNeverNullHasNoNull) {
  EXPECT_EQ(
      json_schema("{scans_lost!, note?!: string}"),
      R"({"type":"object","properties":{"scans_lost":{"type":"integer","description":"number of scans that are missing"},)"
      R"("note":{"type":"string","description":"free text; for an encoder: information about its datum"}},)"
      R"("required":["scans_lost"],"additionalProperties":false})");
}

TEST(Shape, FamilyOfNamesNeedsAtLeastOneMember) {
  const std::string schema = json_schema("{run_{small}, active}");
  EXPECT_NE(schema.find(R"("patternProperties":{"^run_(x|y|z)$":)"), std::string::npos) << schema;
  EXPECT_NE(schema.find(R"("minProperties":2)"), std::string::npos) << schema;
}

TEST(Shape, TwoObjectsAreAlternatives) {
  const std::string schema = json_schema("{active}|{offset}");
  EXPECT_TRUE(schema.starts_with(R"({"anyOf":[{"type":"object","properties":{"active":)"))
      << schema;
}

TEST(Shape, NamedMembersMayBeAbsent) {
  EXPECT_NE(json_schema("{...covers}").find(R"("required":["u_covers","not_declared"])"),
            std::string::npos);
  EXPECT_EQ(json_schema("{...covers?}").find("required"), std::string::npos);
}

TEST(ShapeDeathTest, RejectsANameWithoutARow) {
  EXPECT_DEATH(json_schema("{speed_um_per_h}"), "");
  EXPECT_DEATH(json_schema("{active"), "");
  EXPECT_DEATH(json_schema("{active, active}"), "");
}

}  // namespace
}  // namespace mdof
