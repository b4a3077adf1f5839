// The progress line says the right thing, and a pipe sees nothing unless it is forced.
#include "vpm/base/progress.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <thread>
#include <vector>

#include "vpm/base/clock.h"

namespace vpm {
namespace {

TEST(ProgressLine, ShowsShareAndTimeLeft) {
  EXPECT_EQ(progress_line("photons", 47, 100, 10.6), "photons  [#########-----------]  47 %  12 s left");
  EXPECT_EQ(progress_line("photons", 0, 100, 3.0), "photons  [--------------------]   0 %");
  EXPECT_EQ(progress_line("eye pass", 1, 3, 100.0), "eye pass  [######--------------]  33 %  3 min 20 s left");
  EXPECT_EQ(progress_line("maps", 1, 2, 7500.0), "maps  [##########----------]  50 %  2 h 5 min left");
  EXPECT_EQ(progress_line("maps", 999, 1000, 1.0), "maps  [###################-]  99 %  0 s left");
  EXPECT_EQ(progress_line("maps", 1000, 1000, 1.0), "maps  [####################] 100 %  0 s left");
}

TEST(ProgressLine, TellsNoTimeWhileTooLittleIsDone) {
  EXPECT_EQ(progress_line("render", 9, 100, 3.0, 10), "render  [#-------------------]   9 %");
  EXPECT_EQ(progress_line("render", 10, 100, 3.0, 10), "render  [##------------------]  10 %  27 s left");
}

TEST(ProgressLine, SurvivesOddNumbers) {
  EXPECT_EQ(progress_line("more", 7, 5, 1.0), "more  [####################] 100 %  0 s left");
  EXPECT_EQ(progress_line("slow", 1, uint64_t{1} << 62, 1e30).substr(0, 30), "slow  [--------------------]  ");
}

TEST(ProgressLine, TellsOfAnUnknownTotalOnlyWhatIsDone) {
  EXPECT_EQ(progress_line("photons", 0, 0, 0.0), "photons  0");
  EXPECT_EQ(progress_line("photons", 123456, 0, 2.0), "photons  123456");
  testing::internal::CaptureStderr();
  Progress progress("photons", 0, true);
  progress.advance(7);
  progress.finish();
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "\rphotons  0\rphotons  7  in 0 s\n");
}

/// What stderr gets while four threads do 4000 units of work; stderr is no terminal here.
std::string output(ProgressMode mode) {
  testing::internal::CaptureStderr();
  {
    Progress progress("photons", 4000, progress_enabled(mode));
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i) {
      threads.emplace_back([&] {
        for (int k = 0; k < 1000; ++k) progress.advance();
      });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(progress.done(), 4000u);
  }
  return testing::internal::GetCapturedStderr();
}

TEST(Progress, SilentInAPipe) {
  EXPECT_EQ(output(ProgressMode::automatic), "");
  EXPECT_EQ(output(ProgressMode::never), "");
}

TEST(Progress, ForcedInAPipe) {
  const std::string text = output(ProgressMode::always);
  EXPECT_EQ(text.find("\rphotons  [--------------------]   0 %"), 0u);
  EXPECT_NE(text.find("\rphotons  [####################] 100 %  in "), std::string::npos);
}

TEST(Progress, PrintsAtMostTenTimesASecondAndWipesLongerLines) {
  testing::internal::CaptureStderr();
  const Stopwatch stopwatch;
  Progress progress("wait", 1000000, true);
  while (stopwatch.seconds() < 0.35) progress.advance();
  progress.finish();
  progress.finish();
  const double elapsed = stopwatch.seconds();
  const std::string text = testing::internal::GetCapturedStderr();
  const auto prints = std::count(text.begin(), text.end(), '\r');
  EXPECT_GE(prints, 3);                                          // the start, something in between, the end
  EXPECT_LE(static_cast<double>(prints), 2.0 + 10.0 * elapsed);  // the start, 0.1 s, 0.2 s, ..., the end
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
  std::vector<size_t> lengths;
  for (size_t at = 0; at < text.size();) {
    const size_t next = std::min(text.find('\r', at + 1), text.size());
    lengths.push_back(next - at);
    at = next;
  }
  EXPECT_GE(lengths.back() - 1, lengths[lengths.size() - 2]);  // without its line end
}

TEST(Progress, AnInterruptedStageEndsItsLineWithWhatItReached) {
  testing::internal::CaptureStderr();
  try {
    Progress progress("photons", 100, true);
    progress.advance(25);
    throw 1;
  } catch (int) {
  }
  const std::string text = testing::internal::GetCapturedStderr();
  EXPECT_NE(text.find("\rphotons  [#####---------------]  25 %  in "), std::string::npos);
}

}  // namespace
}  // namespace vpm
