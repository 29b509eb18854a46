// Asio as this folder uses it: standalone, without deprecated names, for its loop: descriptors,
// timers, signals. Sockets are opened and written to by plain system calls. Private header.
#pragma once

#ifndef ASIO_STANDALONE
#define ASIO_STANDALONE
#endif
#ifndef ASIO_NO_DEPRECATED
#define ASIO_NO_DEPRECATED
#endif
#ifdef MDOF_SANITIZED  // TSan does not follow fences; the loop's queues have their mutex
#define ASIO_DISABLE_FENCED_BLOCK
#endif
#include <asio/buffer.hpp>
#include <asio/error.hpp>
#include <asio/io_context.hpp>
#include <asio/posix/stream_descriptor.hpp>
#include <asio/post.hpp>
#include <asio/signal_set.hpp>
#include <asio/steady_timer.hpp>
