#include "tools/mdof/checks/doctor_checks.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace mdof::tools {
namespace {

namespace fs = std::filesystem;

TEST(CheckComedi, EachBoardThatTheKernelHasIsTried) {
  const Machine machine{fs::temp_directory_path() /
                        ("mdof_doctor_checks_test." + std::to_string(::getpid()))};
  EXPECT_TRUE(check_comedi(machine).empty());
  for (const char* part : {"comedi0", "comedi0_subd0", "comedi1"})
    fs::create_directories(machine.at("sys/class/comedi") / part);
  fs::create_directories(machine.at("dev"));
  std::ofstream(machine.at("dev/comedi1")) << "";  // comedi0 has no node that can be opened
  const auto found = check_comedi(machine);
  fs::remove_all(machine.root);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].level, Diagnosis::Level::good);
  EXPECT_EQ(found[0].what, "Comedi board: /dev/comedi1");
  EXPECT_EQ(found[1].level, Diagnosis::Level::bad);
  EXPECT_EQ(found[1].what, "Comedi board: no permission for /dev/comedi0");
  EXPECT_NE(found[1].remedy.find("iocard"), std::string::npos);
}

}  // namespace
}  // namespace mdof::tools
