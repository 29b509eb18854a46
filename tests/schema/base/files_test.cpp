#include "schema/base/files.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

namespace mdof {
namespace {

class TextFile : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(file_); }
  void write(const std::string& bytes) {
    std::ofstream(file_, std::ios::binary)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }
  std::filesystem::path file_ =
      std::filesystem::temp_directory_path() / ("mdof_text_" + std::to_string(::getpid()));
};

TEST_F(TextFile, IsReadCompletelyWithLittleMemory) {
  for (const std::size_t bytes : {0, 1, 16 * 1024, 16 * 1024 + 1, 100'000}) {
    std::string sent(bytes, 'x');
    for (std::size_t i = 0; i < bytes; i += 7) sent[i] = static_cast<char>(i);
    write(sent);
    const auto text = read_text_file(file_);
    ASSERT_TRUE(text) << text.error().message;
    EXPECT_TRUE(*text == sent) << bytes;
    EXPECT_LT(text->capacity(), 2 * bytes + 64 * 1024);
  }
}

TEST_F(TextFile, RejectsAFileOverTheLimit) {
  write(std::string(40'000, 'x'));
  EXPECT_EQ(read_text_file(file_, 40'000)->size(), 40'000u);
  for (const std::size_t limit : {39'999, 20'000, 0}) {
    const auto refused = read_text_file(file_, limit);
    ASSERT_FALSE(refused) << limit;
    EXPECT_NE(refused.error().message.find(file_.string() + ": is larger than"), std::string::npos)
        << refused.error().message;
  }
}

TEST_F(TextFile, RejectsMissingFilesAndFolders) {
  const auto absent = read_text_file(file_);
  ASSERT_FALSE(absent);
  EXPECT_NE(absent.error().message.find("No such file"), std::string::npos)
      << absent.error().message;
  const auto folder = read_text_file(std::filesystem::temp_directory_path());
  ASSERT_FALSE(folder);
  EXPECT_NE(folder.error().message.find("is a folder"), std::string::npos);
}

TEST_F(TextFile, RejectsPipesAndDevicesWithoutWaiting) {
  ASSERT_EQ(::mkfifo(file_.c_str(), 0600), 0);
  for (const std::filesystem::path& path : {file_, std::filesystem::path("/dev/zero")}) {
    const auto refused = read_text_file(path);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find(path.string() + ": is a pipe or a device"),
              std::string::npos);
  }
}

}  // namespace
}  // namespace mdof
