#include "schema/base/sqlite.h"

#include <gtest/gtest.h>

namespace mdof::sqlite {
namespace {

// A text that was gone when the statement ran put foreign bytes into a table's chain.
TEST(Sqlite, KeepsACopyOfAText) {
  auto connection = Connection::open(":memory:", OpenMode::create);
  ASSERT_TRUE(connection) << connection.error().message;
  ASSERT_TRUE(connection->execute("CREATE TABLE t (x TEXT)"));
  {
    auto insert = connection->prepare("INSERT INTO t VALUES (?)");
    std::string text = "Y+ X- Z-";
    insert->bind(text);
    text.assign(8, '#');
    ASSERT_TRUE(insert->run());
  }
  auto row = connection->prepare("SELECT x FROM t");
  ASSERT_TRUE(*row->step());
  EXPECT_EQ(row->text(0), "Y+ X- Z-");
}

}  // namespace
}  // namespace mdof::sqlite
