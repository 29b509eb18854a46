#include "drivers/csv_stream/configure.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace mdof::drivers {
namespace {

std::string refusal(const std::string& toml) {
  auto table = TomlTable::parse(toml, "mdofd.toml");
  if (!table) return table.error().message;
  DriverContext context;
  context.name = "probe";
  context.rig.probes.resize(1);
  context.rig.probes[0].id = "A";
  const auto spec = configure_csv_stream(*table, context);
  if (!spec) return spec.error().message;
  return spec->make().has_value() && spec->live ? "accepted" : "not made";
}

TEST(CsvStreamConfiguration, ReadsKeysAndReportsErrors) {
  EXPECT_EQ(refusal("source = \"tcp://127.0.0.1:9000\"\nsilence_s = 10\nstart_s = 5"), "accepted");
  EXPECT_EQ(refusal("source = \"fifo:/run/probe\"\nbad_lines = 0"), "accepted");
  EXPECT_EQ(refusal("command = [\"python3\", \"p.py\"]\nabsolute = true"), "accepted");
  EXPECT_EQ(refusal("source = \"serial:/dev/ttyUSB0\"\nbaud = 9600\nparity = \"even\"\nstop_bits = "
                    "2\nheader = \"A_um,encoder_mm\""),
            "accepted");
  const std::pair<const char*, const char*> wrong[] = {
      {"", "source: is missing"},
      {"source = \"serial:/dev/ttyS0\"\nbaud = 0", "baud: must be a baud rate"},
      {"source = \"serial:/dev/ttyS0\"\nparity = \"mark\"", "parity: must be \"none\""},
      {"source = \"serial:/dev/ttyS0\"\nheader = \"1,2\"", "header"},
      {"source = \"serial:ttyS0\"", "source: must be"},
      {"source = \"tcp://127.0.0.1:9000\"\nbaud = 9600", "baud"},
      {"source = \"udp://x\"", "mdofd.toml:1: source: must be \"tcp://HOST:PORT\""},
      {"source = \"tcp://host\"", "is not an address"},
      {"command = []", "must contain a program"},
      {"command = [\"a\"]\nsource = \"fifo:b\"",
       "mdofd.toml:2: source: contradicts the key \"command\""},
      {"command = [\"a\"]\nstart_s = 60", "start_s: must be from 0.1 to 5"},
      {"command = [\"a\"]\nbad_lines = -1", "bad_lines: must be from 0 to 10000"},
      {"command = [\"a\"]\nsilense_s = 1", "silence_s"},
  };
  for (const auto& [toml, message] : wrong)
    EXPECT_NE(refusal(toml).find(message), std::string::npos) << toml << " -> " << refusal(toml);
}

}  // namespace
}  // namespace mdof::drivers
