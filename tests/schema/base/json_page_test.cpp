#include "schema/base/json_page.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace mdof {
namespace {

std::string page(const std::vector<std::size_t>& lengths, std::size_t max_bytes,
                 std::size_t& taken) {
  JsonWriter json;
  json.begin_array();
  taken = append_page(
      json, lengths, [](std::size_t n) { return '"' + std::string(n, 'x') + '"'; }, max_bytes);
  return json.end_array().take();
}

TEST(JsonPage, ContainsAsManyItemsAsFit) {
  std::size_t taken = 0;
  EXPECT_EQ(page({1, 2, 3}, 100, taken), R"(["x","xx","xxx"])");
  EXPECT_EQ(taken, 3u);
  // The text ["x","xx" has nine bytes. The third item needs five more bytes.
  EXPECT_EQ(page({1, 2, 3}, 14, taken), R"(["x","xx","xxx"])");
  EXPECT_EQ(page({1, 2, 3}, 13, taken), R"(["x","xx"])");
  EXPECT_EQ(taken, 2u);
}

TEST(JsonPage, EndsBeforeTheFirstItemThatDoesNotFit) {
  std::size_t taken = 0;
  EXPECT_EQ(page({1, 50, 1}, 20, taken), R"(["x"])");
  EXPECT_EQ(taken, 1u);
}

TEST(JsonPage, AlwaysContainsTheFirstItem) {
  std::size_t taken = 0;
  EXPECT_EQ(page({30, 1}, 10, taken), "[\"" + std::string(30, 'x') + "\"]");
  EXPECT_EQ(taken, 1u);
  EXPECT_EQ(page({}, 10, taken), "[]");
  EXPECT_EQ(taken, 0u);
}

}  // namespace
}  // namespace mdof
