#include "drivers/modbus/configure.h"

#include "drivers/channels.h"
#include "drivers/io/device_lock.h"
#include "drivers/io/serial_settings.h"
#include "drivers/modbus/modbus_driver.h"

namespace mdof::drivers {
namespace {

using modbus::Framing;
using modbus::Profile;
using modbus::Value;

void read_ms(TomlTable& table, const char* key, double& ms) {
  ms = table.number(key, ms);
  if (!(ms >= 1 && ms <= 60'000)) table.reject(key, "must be from 1 to 60000");
}

void read_ring(TomlTable& table, Profile& profile) {
  if (!table.has("ring_bits")) return;
  const auto bits = table.integer("ring_bits");
  bool any = false;
  for (Value& value : profile.values) {
    if (value.ring_bits == 0) continue;
    any = true;
    if (bits < 1 || bits > 16 * registers_of(value.type))
      table.reject("ring_bits", "must be from 1 to " +
                                    std::to_string(16 * registers_of(value.type)) +
                                    " (the number of bits of the register)");
    value.ring_bits = static_cast<int>(bits);
  }
  if (!any)
    table.reject("ring_bits", "profile " + profile.name +
                                  " has no value with ring_bits; remove ring_bits from the device");
}

void read_where(TomlTable& table, ModbusSettings& settings) {
  settings.address = table.string("address", "");
  settings.port = table.string("port", "");
  const bool tcp = settings.profile.framing == Framing::tcp;
  if (tcp && settings.address.empty())
    table.reject("address", "is missing; give the TCP address of " + settings.profile.name +
                                ", such as \"192.168.0.5\"");
  else if (settings.address.empty() == settings.port.empty())
    table.reject("port",
                 "give either \"port\" (a serial port, such as \"/dev/ttyUSB0\") or \"address\" "
                 "(the TCP address of a serial device server)");
  if (settings.address.empty()) return;
  if (auto to = parse_endpoint(settings.address, settings.profile.port); !to)
    table.reject("address", to.error().message);
}

Result<const Value*> value_of(const ChannelInput& input, const Profile& profile) {
  std::vector<std::string> names;
  for (const Value& value : profile.values) {
    if (value.name == input.input) return &value;
    names.push_back(value.name);
  }
  return no_such_input(input, names);
}

Status read_uses(TomlTable& table, const Rig& rig, ModbusSettings& settings) {
  MDOF_TRY(const auto inputs, read_channels(table, rig));
  for (ChannelInput input : inputs) {
    MDOF_TRY(const Value* value, value_of(input, settings.profile));
    const bool counts = value->unit == Unit::other;
    if (input.um_per_count == 0) input.um_per_count = value->um_per_count;
    if (counts)
      MDOF_CHECK(check_um_per_count(input));
    else if (input.um_per_count != 0)
      return bad_input(input.where + ": um_per_count applies to counts, but the value \"" +
                       input.input + "\" is in " + suffix(value->unit) +
                       "; remove um_per_count from the channel or from the profile");
    if (input.id == kEncoderChannel) settings.encoder = encoder_origin({input}, value->incremental);
    settings.channels.push_back({input.id, counts ? Unit::um : value->unit});
    settings.uses.push_back({*value, input.um_per_count});
  }
  return {};
}

// A Modbus TCP address may serve several units, each with its own connection.
std::string identity(const ModbusSettings& settings) {
  if (settings.address.empty()) return identity_of_path(settings.port);
  const auto at = parse_endpoint(settings.address, settings.profile.port);
  std::string where = at ? identity_of(*at) : settings.address;
  if (settings.profile.framing == Framing::rtu) return where;
  return where + " unit " + std::to_string(settings.profile.unit);
}

}  // namespace

Result<DriverSpec> configure_modbus(TomlTable& table, const DriverContext& context) {
  const std::string name = table.string("profile");
  if (name.empty()) MDOF_CHECK(table.finish());
  auto profile = modbus::load_profile(name, context.base_path);
  if (!profile) return in_context(table.where("profile"), profile.error());
  ModbusSettings settings;
  settings.profile = std::move(*profile);
  read_serial_settings(table, settings.profile.serial);
  settings.profile.unit = static_cast<int>(table.integer("unit", settings.profile.unit));
  if (settings.profile.unit < 1 || (settings.profile.unit > 247 && settings.profile.unit != 255))
    table.reject("unit", "must be from 1 to 247, or 255");
  read_ms(table, "poll_ms", settings.profile.poll_ms);
  read_ms(table, "response_timeout_ms", settings.profile.response_timeout_ms);
  read_ring(table, settings.profile);
  read_where(table, settings);
  MDOF_CHECK(read_uses(table, context.rig, settings));
  MDOF_CHECK(table.finish());
  DriverSpec spec;
  for (const auto& channel : settings.channels) spec.channels.push_back(channel.id);
  spec.encoder = settings.encoder;
  spec.identity = [settings] { return identity(settings); };
  spec.shared = !settings.address.empty() && settings.profile.framing != Framing::rtu;
  spec.make = make_of<ModbusDriver>(context.name, settings);
  return spec;
}

}  // namespace mdof::drivers
