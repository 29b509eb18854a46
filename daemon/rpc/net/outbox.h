// The lines that wait until they can be sent to a client. Private header.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace mdof::rpc {

class Outbox {
 public:
  // Append only whole lines.
  std::string& text() { return text_; }
  std::size_t unsent() const { return text_.size() - sent_; }

  // Sends as many bytes as the socket accepts without blocking. Returns the number of bytes;
  // nullopt: the connection is broken.
  std::optional<std::size_t> flush(int socket);

 private:
  void forget_sent();

  std::string text_;
  std::size_t sent_ = 0;  // number of bytes of text_ that were sent already
};

}  // namespace mdof::rpc
