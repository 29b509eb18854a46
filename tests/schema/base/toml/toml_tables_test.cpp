// Several readers of one table. Each reader reads some of the keys.
#include <gtest/gtest.h>

#include "schema/base/toml/toml_reader.h"

namespace mdof {
namespace {

constexpr const char* kText = "[[channel]]\nid = \"A\"\ndelay_us = 5\n[[channel]]\nid = \"B\"\n";

std::string after(const std::vector<const char*>& keys_of_second) {
  auto root = TomlTable::parse(kText, "mdofd.toml").value();
  for (auto& table : root.tables("channel")) table.number("delay_us", 0);
  for (auto& table : root.tables("channel"))
    for (const char* key : keys_of_second) table.string(key, "");
  const Status finished = root.finish();
  return finished ? "" : finished.error().message;
}

TEST(TomlTables, KeyReadByOneOfTheReadersIsKnown) {
  EXPECT_EQ(after({"id"}), "");
  EXPECT_NE(after({}).find("mdofd.toml:2: channel[1].id: unknown key"), std::string::npos)
      << after({});
}

TEST(TomlTables, AnUnknownKeyListsEachKnownKeyOnce) {
  auto root = TomlTable::parse("colour = 1\n", "mdofd.toml").value();
  EXPECT_FALSE(root.has("delay_us"));
  root.number("delay_us", 0);
  EXPECT_TRUE(root.finish().error().message.ends_with("unknown key; known keys: delay_us"))
      << root.finish().error().message;
}

TEST(TomlTables, HaveTheSameOrderForEachReader) {
  auto root = TomlTable::parse(kText, "mdofd.toml").value();
  for (int reader = 0; reader < 2; ++reader) {
    auto tables = root.tables("channel");
    ASSERT_EQ(tables.size(), 2u);
    EXPECT_EQ(tables[0].string("id"), "A");
    EXPECT_EQ(tables[1].string("id"), "B");
  }
}

TEST(TomlTables, ContentHasNoCommentsAndNoOrder) {
  const std::string content = TomlTable::content("a = 1\nb = 2.5\n[c]\nx = [1, 2]\n");
  EXPECT_EQ(TomlTable::content("# of 2026\nb = 2.50  # um\n\na=1\n[c]\nx = [ 1,\n 2 ]\n"), content);
  EXPECT_NE(TomlTable::content("a = 1\nb = 2.5000000000000004\n[c]\nx = [1, 2]\n"), content);
  EXPECT_NE(TomlTable::content("a = 1\nb = 2.5\n[c]\nx = [2, 1]\n"), content);
  EXPECT_EQ(TomlTable::content("a = 1\n[report]\ndate = \"2026-01-01\"\n[c]\nx = [1, 2]\n[d]\n",
                               {"report", "d"}),
            TomlTable::content("a = 1\n[c]\nx = [1, 2]\n"));
  EXPECT_EQ(TomlTable::content("no document"), "no document");
}

}  // namespace
}  // namespace mdof
