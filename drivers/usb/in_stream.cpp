#include "drivers/usb/in_stream.h"

#include <utility>

#include "drivers/usb/transfer.h"

namespace mdof::drivers::usb {

Result<InStream> InStream::start(const Handle& handle, const Options& options) {
  InStream stream;
  stream.connection_ = handle.connection();
  for (std::size_t i = 0; i < options.transfers; ++i) {
    stream.transfers_.push_back(std::make_unique<Transfer>(*stream.connection_, options.bytes));
    Transfer& transfer = *stream.transfers_.back();
    if (transfer.raw) transfer.raw->endpoint = options.endpoint;
    MDOF_CHECK(transfer.submit());
  }
  return stream;
}

InStream::~InStream() {
  end();
}
InStream::InStream(InStream&& other) noexcept = default;
InStream& InStream::operator=(InStream&& other) noexcept {
  if (this == &other) return *this;
  end();
  connection_ = std::move(other.connection_);
  transfers_ = std::move(other.transfers_);
  other.transfers_.clear();
  oldest_ = other.oldest_;
  given_ = other.given_;
  stalled_ = other.stalled_;
  ended_ = std::move(other.ended_);
  return *this;
}

void InStream::end() {
  if (connection_ && !transfers_.empty()) cancel_and_free(*connection_, transfers_);
}

void InStream::cancel() {
  (void)cancel_all(*connection_, transfers_);
}

Status InStream::submit_returned_transfer() {
  if (!std::exchange(given_, false)) return {};
  MDOF_CHECK(transfers_[oldest_]->submit());
  oldest_ = (oldest_ + 1) % transfers_.size();
  return {};
}

Result<InStream::Chunk> InStream::next(Deadline deadline) {
  if (!ended_) return tl::unexpected(ended_.error());
  if (ended_ = submit_returned_transfer(); !ended_) return tl::unexpected(ended_.error());
  const Transfer& oldest = *transfers_[oldest_];
  if (!connection_->pump(deadline, [&] { return !oldest.in_flight; })) return Chunk{};
  const auto status = oldest.raw->status;
  if (status != LIBUSB_TRANSFER_COMPLETED) {
    stalled_ = status == LIBUSB_TRANSFER_STALL;
    ended_ = io_error(text_of(status));
    if (oldest.raw->actual_length == 0) return tl::unexpected(ended_.error());
  }
  given_ = ended_.has_value();
  const auto* bytes = reinterpret_cast<const char*>(oldest.buffer.data());
  return Chunk{{bytes, static_cast<std::size_t>(oldest.raw->actual_length)}, oldest.done_ns, true};
}

}  // namespace mdof::drivers::usb
