// Tables of phase functions as text.
#include "vpm/input/phase_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "vpm/base/error.h"
#include "vpm/base/vec.h"

namespace vpm {
namespace {

std::string file_of(const std::string& text) {
  const std::string path = testing::TempDir() + "phase.csv";
  std::ofstream(path) << text;
  return path;
}

TEST(PhaseFile, TakesCommasSpacesAndAHeading) {
  for (const char* text :
       {"angle,value\n0,2\n90,2\n180,2\n", "# by hand\n\n  0 \t2\n9e1 +2\r\n180 2.0\n", "0;2\n180;2"}) {
    const auto table = load_phase_table(file_of(text));
    EXPECT_NEAR(table->total(), 8.0 * kPiD, 1e-9);
    EXPECT_NEAR(table->value(0.3f), 1.0f / (4.0f * kPi), 1e-7f);
  }
}

TEST(PhaseFile, TakesCosinesAndFallingPlaces) {
  const auto of_degrees = load_phase_table(file_of("0,9\n60,3\n90,2\n180,1\n"));
  for (const char* text : {"180,1\n90,2\n60,3\n0,9\n", "mu,p\n-1,1\n0,2\n0.5,3\n1,9\n", "1,9\n0.5,3\n0,2\n-1,1\n"}) {
    const auto table = load_phase_table(file_of(text));
    EXPECT_NEAR(table->total(), of_degrees->total(), 1e-9) << text;
    for (const float s : {0.0f, 0.3f, 0.6f, 0.9f}) EXPECT_NEAR(table->value(s), of_degrees->value(s), 1e-7f) << text;
  }
}

TEST(PhaseFile, ThreeColumnsBecomeTheMeanOfNormalisedOnes) {
  const auto mean = load_phase_table(file_of("0,1,0,3\n180,1,4,3\n"));
  const auto back = load_phase_table(file_of("0,0\n180,1\n"));
  EXPECT_EQ(mean->columns(), 3);
  EXPECT_NEAR(mean->total(), 1.0, 1e-12);
  for (const float s : {0.1f, 0.5f, 0.9f})
    EXPECT_NEAR(mean->value(s), (2.0f / (4.0f * kPi) + back->value(s)) / 3.0f, 1e-7f);
}

TEST(PhaseFile, RefusesWithFileAndLine) {
  const auto refused = [](const std::string& text, const std::string& why) {
    try {
      load_phase_table(file_of(text));
      ADD_FAILURE() << text;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
    }
  };
  refused("0,1\n90,x\n180,1\n", "phase.csv:2: a line of a phase function is an angle");
  refused("0,1,2\n180,1,2\n", "phase.csv:1: ");
  refused("0,1,2,3\n90,1\n180,1,2,3\n", "phase.csv:2: ");
  refused("-1,1\n2,1\n1,1\n", "2 stands among cosines");
  refused("-1,1\n0.5,1\n0.2,1\n1,1\n", "the angles of a phase function rise");
  refused("0,1\n180,1\n200,1\n", "go from 0 to 180 degrees, not from 0 to 200");
  refused("0,1\n90,-1\n180,1\n", "at 90 degrees is -1");
  refused("a,b\nc,d\n", "phase.csv:2: ");
  refused("", "two angles at least");
}

}  // namespace
}  // namespace vpm
