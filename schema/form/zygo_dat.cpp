// The binary format of Zygo's MetroPro: a header, the intensities, the connected phase. Numbers are
// big-endian. The phase is an integer, and `phase_res` gives the counts per fringe:
// height = phase * intf_scale_factor * obliquity_factor * wavelength / counts per fringe.
// The rows begin at the top left of the camera (MetroPro Reference Guide, "Data Format and
// Conversion"), and SurfaceMap begins with the lowest row. H. Yamamoto's LoadMetroProData.m (LIGO)
// and pyopticslab (ESRF) reverse the rows, too.
#include <bit>
#include <cmath>
#include <cstdint>

#include "schema/base/number/number_text.h"
#include "schema/form/map_grid.h"
#include "schema/form/surface_files.h"

namespace mdof {
namespace {

// The next byte of the file is 'o', 'p' or 'q' for the format.
constexpr std::string_view kMagic = "\x88\x1b\x03";
constexpr std::size_t kLeastHeader = 834;
constexpr std::int32_t kNoPhase = 2147483640;  // this value or above: no phase

// Positions of values in the header.
enum Offset : std::size_t {
  kHeaderSize = 6,
  kIntensityBytes = 60,
  kOrgX = 64,
  kOrgY = 66,
  kWidth = 68,
  kHeight = 70,
  kScaleFactor = 164,
  kWavelength = 168,
  kObliquity = 176,
  kLateral = 184,
  kPhaseRes = 218,
  kSign = 232,
  kCameraHeight = 236
};

class Header {
 public:
  explicit Header(std::string_view bytes) : bytes_(bytes) {}
  std::uint32_t u32(std::size_t at) const {
    return std::uint32_t{byte(at)} << 24 | std::uint32_t{byte(at + 1)} << 16 |
           std::uint32_t{byte(at + 2)} << 8 | std::uint32_t{byte(at + 3)};
  }
  std::uint16_t u16(std::size_t at) const {
    return static_cast<std::uint16_t>(byte(at) << 8 | byte(at + 1));
  }
  std::int16_t i16(std::size_t at) const { return static_cast<std::int16_t>(u16(at)); }
  double real(std::size_t at) const { return std::bit_cast<float>(u32(at)); }

 private:
  unsigned char byte(std::size_t at) const { return static_cast<unsigned char>(bytes_[at]); }
  std::string_view bytes_;
};

Result<double> height_of_a_count(const Header& header, const std::string& source) {
  double counts = 0;
  switch (header.i16(kPhaseRes)) {
    case 0:
      counts = 4096;
      break;
    case 1:
      counts = 32768;
      break;
    case 2:
      counts = 131072;
      break;
    default:
      return bad_input(source + ": phase_res is " + std::to_string(header.i16(kPhaseRes)) +
                       ", but must be 0, 1 or 2; the file is damaged or not a MetroPro file");
  }
  const double scale_m =
      header.real(kScaleFactor) * header.real(kObliquity) * header.real(kWavelength) / counts;
  if (!(std::isfinite(scale_m) && scale_m != 0))
    return bad_input(
        source +
        ": the wavelength, the scale factor or the obliquity factor is missing in the header");
  return header.i16(kSign) == 0 ? scale_m : -scale_m;
}

}  // namespace

bool is_zygo_dat(std::string_view bytes) {
  return bytes.size() >= 4 && bytes.starts_with(kMagic) && bytes[3] >= 'o' && bytes[3] <= 'q';
}

Result<SurfaceMap> parse_zygo_dat(std::string_view bytes, const std::string& source) {
  if (bytes.size() < kLeastHeader)
    return bad_input(source + ": ends within the header of a MetroPro file");
  const Header header(bytes);
  SurfaceMap map;
  map.name = source;
  map.nx = header.u16(kWidth);
  map.ny = header.u16(kHeight);
  if (map.nx == 0 || map.ny == 0)
    return bad_input(source +
                     ": contains no connected phase data, and so no heights; save the measurement "
                     "with phase data");
  if (map.nx * map.ny > kMostPixels)
    return bad_input(source + ": has more than " + std::to_string(kMostPixels) + " pixels");
  const std::size_t begin =
      std::size_t{header.u32(kHeaderSize)} + std::size_t{header.u32(kIntensityBytes)};
  if (header.u32(kHeaderSize) < kLeastHeader || begin + 4 * map.nx * map.ny > bytes.size())
    return bad_input(
        source + ": has " + std::to_string(bytes.size()) + " bytes, but the header requires " +
        std::to_string(begin + 4 * map.nx * map.ny) + "; the file is truncated or damaged");
  map.dx_m = map.dy_m = header.real(kLateral);
  if (!(map.dx_m > 0 && std::isfinite(map.dx_m)))
    return bad_input(source +
                     ": the lateral resolution is 0, so the size of a pixel is unknown; "
                     "calibrate the resolution in MetroPro, or export x, y and z");
  if (map.dx_m > kLargestPixel_m)
    return bad_input(source + ": the lateral resolution is " + plain_number(map.dx_m) +
                     " m, above the limit of " + plain_number(kLargestPixel_m) +
                     " m; the file is damaged");
  map.x0_m = header.i16(kOrgX) * map.dx_m;
  const int first = header.i16(kOrgY), lowest = first + static_cast<int>(map.ny) - 1;
  const int rows = header.i16(kCameraHeight);
  const bool is_known = rows > lowest;
  const int at_zero = is_known ? rows - 1 : first == 0 ? lowest : 0;
  map.y0_m = (at_zero - lowest) * map.dy_m;
  MDOF_TRY(const double scale_m, height_of_a_count(header, source));
  map.z_m.resize(map.nx * map.ny);
  for (std::size_t k = 0; k < map.z_m.size(); ++k) {
    const auto phase = static_cast<std::int32_t>(header.u32(begin + 4 * k));
    double& z_m = map.z_m[(map.ny - 1 - k / map.nx) * map.nx + k % map.nx];
    z_m = phase >= kNoPhase ? SurfaceMap::kMissing : phase * scale_m;
    if (std::abs(z_m) > kFarthest_m)
      return bad_input(source +
                       ": a height is above 1000 m; the wavelength, the scale factor or the phase "
                       "is wrong, or the file is damaged");
  }
  if (map.measured() == 0) return bad_input(source + ": no pixel has a phase");
  return map;
}

}  // namespace mdof
