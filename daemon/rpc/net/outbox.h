// Lines on their way to a client. Private header.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace mdof::rpc {

class Outbox {
 public:
  // To append whole lines to.
  std::string& text() { return text_; }
  std::size_t unsent() const { return text_.size() - sent_; }

  // Sends what the socket takes without waiting. Bytes sent; nothing: the connection is broken.
  std::optional<std::size_t> flush(int socket);

 private:
  void forget_sent();

  std::string text_;
  std::size_t sent_ = 0;  // of text_
};

}  // namespace mdof::rpc
