// Running a program from a test: what it prints, how it ends, what memory it takes, under limits of time and address
// space.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "vpm/base/clock.h"

namespace vpm {

/// What a program may use before it is stopped.
struct ProcessLimits {
  double seconds = 120.0;      // then it is killed, and the test fails
  uint64_t address_space = 0;  // bytes, the program itself included; 0: no limit
  std::string folder = ".";    // where it runs
};

/// How a program ended.
struct ProcessResult {
  int status = -1;           // exit status; minus the signal's number where a signal ended it
  std::string out, err;      // what it printed
  uint64_t peak_memory = 0;  // bytes resident
  double seconds = 0.0;      // wall clock
};

/// A program that runs. Its output goes to files, which are no terminal, as little as a pipe is one.
class Process {
 public:
  Process(const std::vector<std::string>& arguments, const ProcessLimits& limits = {}) : limits_(limits) {
    std::vector<char*> argv;
    for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
    argv.push_back(nullptr);
    id_ = fork();
    if (id_ == 0) become(argv.data());
    EXPECT_GT(id_, 0) << "no process can be started";
  }
  ~Process() {
    if (!ended_) {
      signal(SIGKILL);
      wait();
    }
    std::fclose(out_);
    std::fclose(err_);
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  void signal(int number) const { kill(id_, number); }

  /// Waits until the program's error output contains `text`; false where it ends, or its time does, before.
  bool wait_for_error_output(const std::string& text) {
    while (contents(err_).find(text) == std::string::npos)
      if (has_ended()) return false;
    return true;
  }

  /// Waits for the end.
  ProcessResult wait() {
    while (!has_ended()) {
    }
    result_.out = contents(out_);
    result_.err = contents(err_);
    return result_;
  }

 private:
  /// The child's part: limits, signals as at a terminal, output, and the program in this one's place.
  [[noreturn]] void become(char* const* argv) const {
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) ::signal(number, SIG_DFL);
    if (limits_.address_space > 0) {
      const rlimit limit{limits_.address_space, limits_.address_space};
      setrlimit(RLIMIT_AS, &limit);
    }
    const int nothing = open("/dev/null", O_RDONLY);
    const bool ready = nothing >= 0 && dup2(nothing, STDIN_FILENO) >= 0 && dup2(fileno(out_), STDOUT_FILENO) >= 0 &&
                       dup2(fileno(err_), STDERR_FILENO) >= 0 && chdir(limits_.folder.c_str()) == 0;
    if (ready) execv(argv[0], argv);
    _exit(127);
  }

  /// Looks, after a short rest, whether the program is still there; kills it where its time is over.
  bool has_ended() {
    if (ended_) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    result_.seconds = stopwatch_.seconds();
    const bool late = result_.seconds > limits_.seconds;
    if (late) {
      ADD_FAILURE() << "still running after " << limits_.seconds << " s; killed";
      kill(id_, SIGKILL);
    }
    int status = 0;
    rusage usage{};
    if (wait4(id_, &status, late ? 0 : WNOHANG, &usage) != id_) return false;
    result_.status = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    result_.peak_memory = static_cast<uint64_t>(usage.ru_maxrss) * 1024;
    return ended_ = true;
  }

  static std::string contents(std::FILE* file) {
    std::string text(static_cast<size_t>(lseek(fileno(file), 0, SEEK_CUR)), '\0');
    const ssize_t n = pread(fileno(file), text.data(), text.size(), 0);
    text.resize(n > 0 ? static_cast<size_t>(n) : 0);
    return text;
  }

  const ProcessLimits limits_;
  const Stopwatch stopwatch_;
  std::FILE* const out_ = std::tmpfile();
  std::FILE* const err_ = std::tmpfile();
  pid_t id_ = -1;
  bool ended_ = false;
  ProcessResult result_;
};

/// Runs a program to its end.
inline ProcessResult run_program(const std::vector<std::string>& arguments, const ProcessLimits& limits = {}) {
  return Process(arguments, limits).wait();
}

/// The path of the first of these programs that a folder of PATH has; nothing where there is none.
inline std::optional<std::string> program_in_path(const std::vector<std::string>& names) {
  const char* folders = std::getenv("PATH");
  std::istringstream path(folders ? folders : "");
  for (std::string folder; std::getline(path, folder, ':');)
    for (const std::string& name : names)
      if (const std::string file = folder + "/" + name; access(file.c_str(), X_OK) == 0) return file;
  return std::nullopt;
}

}  // namespace vpm
