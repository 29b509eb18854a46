// Compares the driver with the functions of comedilib that need no board: conversions and
// calibration files. Sources, in Linux-Comedi/comedilib:
// - lib/range.c: comedi_to_phys
// - lib/calib.c: comedi_to_physical, comedi_get_softcal_converter
// - lib/calib_yacc.y: the calibration file
#include <comedilib.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "drivers/linux_comedi/protocol.h"

namespace mdof::drivers::linux_comedi {
namespace {

TEST(ComediVectors, NominalVoltsEqualComedilibs) {
  comedi_range range{-5, 5, UNIT_volt};
  const Polynomial own = nominal({-5, 5}, 4095);
  for (const lsampl_t code : {1U, 7U, 2047U, 2048U, 4094U})
    EXPECT_NEAR(volts(code, own), comedi_to_phys(code, &range, 4095), 1e-12) << code;
}

TEST(ComediVectors, RailsAreWhereComedilibReturnsNan) {
  comedi_set_global_oor_behavior(COMEDI_OOR_NAN);
  comedi_range range{0, 10, UNIT_volt};
  for (const lsampl_t code : {0U, 1U, 65534U, 65535U, 70000U})
    EXPECT_EQ(at_rail(code, 65535), std::isnan(comedi_to_phys(code, &range, 65535))) << code;
}

TEST(ComediVectors, FilePolynomialGivesComedilibsVolts) {
  const auto path = std::filesystem::temp_directory_path() /
                    ("mdof_comedi_calibration." + std::to_string(::getpid()));
  std::ofstream(path) << R"({
    driver_name => "ni_pcimio",
    board_name => "pci-6221",
    calibrations =>
    [
      {
        subdevice => 0,
        channels => [],
        ranges => [1],
        arefs => [],
        caldacs => [],
        softcal_to_phys =>
        {
          coefficients => [-0.00125, 3.0625e-04, -2.5e-12, 1.25e-17],
          expansion_origin => 32768.5
        }
      },
    ]
  })";
  comedi_calibration_t* file = comedi_parse_calibration_file(path.c_str());
  std::filesystem::remove(path);
  ASSERT_NE(file, nullptr);
  EXPECT_STREQ(file->board_name, "pci-6221");
  comedi_polynomial_t theirs{};
  ASSERT_EQ(comedi_get_softcal_converter(0, 3, 1, COMEDI_TO_PHYSICAL, file, &theirs), 0);
  EXPECT_NE(comedi_get_softcal_converter(0, 3, 0, COMEDI_TO_PHYSICAL, file, &theirs), 0);
  Polynomial own;
  own.origin = theirs.expansion_origin;
  ASSERT_EQ(theirs.order, 3U);
  for (std::size_t i = 0; i < 4; ++i) own.coefficients[i] = theirs.coefficients[i];
  EXPECT_EQ(own.origin, 32768.5);
  for (const lsampl_t code : {1U, 20'000U, 32'768U, 65'534U})
    EXPECT_NEAR(volts(code, own), comedi_to_physical(code, &theirs), 1e-12) << code;
  EXPECT_NEAR(volts(65'534, own), 10.0319, 1e-3);
  comedi_cleanup_calibration(file);
}

}  // namespace
}  // namespace mdof::drivers::linux_comedi
