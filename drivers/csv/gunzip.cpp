#include "drivers/csv/gunzip.h"

#include <zlib.h>

#include <new>
#include <string>

namespace mdof::drivers {
namespace {

constexpr int kGzipOnly = 16 + MAX_WBITS;

std::string position_text(std::uint64_t unpacked) {
  return " after " + std::to_string(unpacked) + " bytes of unpacked text; ";
}

}  // namespace

Gunzip::Gunzip() : stream_(std::make_unique<z_stream>()) {
  if (inflateInit2(stream_.get(), kGzipOnly) != Z_OK) throw std::bad_alloc();
}

Gunzip::~Gunzip() {
  inflateEnd(stream_.get());
}

Status Gunzip::next_member(std::string_view& input) {
  if (unpacked_ > 0 && (padding_ || input[0] == 0)) {
    padding_ = true;
    const std::size_t rest = input.find_first_not_of('\0');
    input.remove_prefix(rest == input.npos ? input.size() : rest);
    if (input.empty()) return {};
    return bad_input("other data follow the end of the gzip data" + position_text(unpacked_) +
                     "copy the file again");
  }
  inflateReset(stream_.get());
  between_members_ = false;
  return {};
}

Result<std::size_t> Gunzip::unpack(std::string_view& input, char* to, std::size_t capacity) {
  if (between_members_ && !input.empty()) MDOF_CHECK(next_member(input));
  if (input.empty()) return 0;
  stream_->next_in = reinterpret_cast<Bytef*>(const_cast<char*>(input.data()));
  stream_->avail_in = static_cast<uInt>(input.size());
  stream_->next_out = reinterpret_cast<Bytef*>(to);
  stream_->avail_out = static_cast<uInt>(capacity);
  const int state = inflate(stream_.get(), Z_NO_FLUSH);
  input.remove_prefix(input.size() - stream_->avail_in);
  const std::size_t count = capacity - stream_->avail_out;
  unpacked_ += count;
  if (state == Z_STREAM_END) {
    between_members_ = true;
  } else if (state != Z_OK && state != Z_BUF_ERROR) {
    return bad_input(std::string("the gzip data are damaged (") +
                     (stream_->msg ? stream_->msg : "invalid stream") + ")" +
                     position_text(unpacked_) + "copy the file again");
  }
  return count;
}

Status Gunzip::check_end() const {
  if (between_members_) return {};
  return bad_input("the gzip file is truncated: it ends" + position_text(unpacked_) +
                   "copy the file again");
}

}  // namespace mdof::drivers
