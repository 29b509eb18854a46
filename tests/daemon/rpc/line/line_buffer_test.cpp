#include "daemon/rpc/line/line_buffer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace mdof::rpc {
namespace {

void put(LineBuffer& buffer, std::string_view bytes) {
  const auto space = buffer.space();
  ASSERT_LE(bytes.size(), space.size());
  std::copy(bytes.begin(), bytes.end(), space.begin());
  buffer.received(bytes.size());
}

TEST(LineBuffer, SplitsLinesForAnyDivisionOfTheBytes) {
  const std::string text = "a\n\nbc\r\ndef\n";
  for (std::size_t step = 1; step <= text.size(); ++step) {
    LineBuffer buffer(16, 64);
    std::string seen;
    for (std::size_t i = 0; i < text.size(); i += step) {
      put(buffer, std::string_view(text).substr(i, step));
      while (const auto line = buffer.next()) seen += std::string(line->text) + "|";
    }
    EXPECT_EQ(seen, "a||bc|def|") << step;
    EXPECT_FALSE(buffer.partial());
  }
}

TEST(LineBuffer, DetectsAPartialLine) {
  LineBuffer buffer(16, 64);
  put(buffer, "a\nb");
  EXPECT_FALSE(buffer.partial());  // the buffer begins with a whole line
  buffer.next();
  EXPECT_TRUE(buffer.partial());
  EXPECT_FALSE(buffer.next());
}

TEST(LineBuffer, ALineMayHaveExactlyItsLimit) {
  for (const auto& [text, too_long] :
       {std::pair("12345678\n", false), std::pair("12345678\r\n", false),
        std::pair("123456789\n", true), std::pair("1234567890", true)}) {
    LineBuffer buffer(8, 64);
    put(buffer, text);
    const auto line = buffer.next();
    ASSERT_TRUE(line) << text;
    EXPECT_EQ(line->too_long, too_long) << text;
  }
}

}  // namespace
}  // namespace mdof::rpc
