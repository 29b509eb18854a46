// Includes Boost.Asio without deprecated names. This folder uses the event loop of Boost.Asio for
// descriptors, timers and signals, but opens and writes sockets with plain system calls. The
// standalone Asio library is not used, because Boost.Beast (daemon/rpc/web/) needs Boost.Asio, and
// one program must not contain both. Private header.
#pragma once

#ifndef BOOST_ASIO_NO_DEPRECATED
#define BOOST_ASIO_NO_DEPRECATED
#endif
#ifdef MDOF_SANITIZED  // TSan does not support fences; a mutex protects the loop's queues
#define BOOST_ASIO_DISABLE_FENCED_BLOCK
#endif
#include <boost/asio/buffer.hpp>
#include <boost/asio/error.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>

namespace mdof::rpc {

namespace asio = boost::asio;
using LoopError = boost::system::error_code;  // result of a wait

}  // namespace mdof::rpc
