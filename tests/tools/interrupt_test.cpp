#include "tools/mdof/interrupt.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

namespace mdof::tools {
namespace {

TEST(InterruptDeathTest, ASecondSignalEndsTheProgram) {
  EXPECT_EXIT(
      {
        const Interrupt interrupt;
        std::raise(SIGINT);
        if (!Interrupt::requested()) std::exit(1);
        std::raise(SIGINT);
        std::exit(0);
      },
      testing::KilledBySignal(SIGINT), "");
}

TEST(InterruptDeathTest, ASecondSignalIsIgnoredUntilTheObjectIsDestroyed) {
  EXPECT_EXIT(
      {
        {
          const Interrupt interrupt(Interrupt::Further::is_ignored);
          for (int i = 0; i < 3; ++i) std::raise(SIGINT);
          if (!Interrupt::requested()) std::exit(1);
        }
        std::raise(SIGINT);
        std::exit(0);
      },
      testing::KilledBySignal(SIGINT), "");
}

}  // namespace
}  // namespace mdof::tools
