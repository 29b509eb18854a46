// Boost.Asio as this folder uses it: without deprecated names, for its loop: descriptors, timers,
// signals. Sockets are opened and written to by plain system calls. Not the standalone Asio:
// Boost.Beast (daemon/rpc/web/) does not run on that, and the two must not meet. Private header.
#pragma once

#ifndef BOOST_ASIO_NO_DEPRECATED
#define BOOST_ASIO_NO_DEPRECATED
#endif
#ifdef MDOF_SANITIZED  // TSan does not follow fences; the loop's queues have their mutex
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
using LoopError = boost::system::error_code;  // what a wait ended with

}  // namespace mdof::rpc
