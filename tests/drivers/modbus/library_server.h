// A Modbus slave that uses the server functions of libmodbus, on one end of a pair of sockets.
#pragma once

#include <gtest/gtest.h>
#include <modbus/modbus.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <memory>
#include <thread>

#include "drivers/io/byte_stream.h"

namespace mdof::drivers {

class LibraryServer {
 public:
  enum class Kind { tcp, rtu };
  // The slave has the holding and input registers 0 ... 199. Holding register n contains 1000 + n,
  // input register n contains 2000 + n.
  explicit LibraryServer(Kind kind, int unit = 1) : tcp_(kind == Kind::tcp) {
    EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends_.data()), 0);
    context_.reset(tcp_ ? ::modbus_new_tcp("127.0.0.1", 1502)
                        : ::modbus_new_rtu("/dev/null", 19200, 'E', 8, 1));
    map_.reset(::modbus_mapping_new(0, 0, 200, 200));
    for (std::uint16_t i = 0; i < 200; ++i) {
      map_->tab_registers[i] = static_cast<std::uint16_t>(1000 + i);
      map_->tab_input_registers[i] = static_cast<std::uint16_t>(2000 + i);
    }
    ::modbus_set_slave(context_.get(), unit);
    ::modbus_set_socket(context_.get(), ends_[1]);
    thread_ = std::thread([this] { serve(); });
  }
  ~LibraryServer() {
    ::shutdown(ends_[1], SHUT_RDWR);
    thread_.join();
    ::close(ends_[1]);
  }
  ByteStream connect() { return ByteStream(ends_[0], "pair"); }

 private:
  void serve() {
    std::array<std::uint8_t, MODBUS_MAX_ADU_LENGTH> query;
    for (;;) {
      const int size = ::modbus_receive(context_.get(), query.data());
      if (size < 0) return;
      if (size > 0) ::modbus_reply(context_.get(), query.data(), size, map_.get());
    }
  }

  bool tcp_;
  std::array<int, 2> ends_{};
  std::unique_ptr<modbus_t, decltype(&::modbus_free)> context_{nullptr, &::modbus_free};
  std::unique_ptr<modbus_mapping_t, decltype(&::modbus_mapping_free)> map_{nullptr,
                                                                           &::modbus_mapping_free};
  std::thread thread_;
};

}  // namespace mdof::drivers
