// SPDX-License-Identifier: BSD-3-Clause
#include "progress.h"

#include "options.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <unistd.h>

namespace pcl_gpf {

namespace {

constexpr double kBarPeriod = 0.1;   // seconds
constexpr double kLinePeriod = 10.0; // seconds
constexpr int kBarWidth = 30;

std::string
timeLeft(double elapsed, double fraction)
{
  // The first hundredth says nothing about the rest.
  if (fraction < 0.01 || elapsed < 0.2)
    return "";
  const double left = elapsed / fraction * (1.0 - fraction);
  const long seconds = std::lround(std::min(left, 359999.0));
  if (seconds < 100)
    return "  ETA " + std::to_string(seconds) + " s";
  return "  ETA " + std::to_string(seconds / 60) + " min " + std::to_string(seconds % 60) + " s";
}

} // namespace

Progress::Progress(const Options& options, Of of) : mode_(Mode::None), of_(of), begin_(Clock::now()), last_shown_(begin_)
{
  const std::string& name = options.text("progress");
  if (options.given("quiet") || name == "none")
    return;
  if (name == "auto")
    mode_ = ::isatty(STDERR_FILENO) ? Mode::Bar : Mode::RareLines;
  else
    mode_ = name == "bar" ? Mode::Bar : Mode::Lines;
}

Progress::~Progress()
{
  clear();
}

bool
Progress::update(const std::string& stage, double fraction)
{
  const Clock::time_point now = Clock::now();
  fraction = std::clamp(fraction, 0.0, 1.0);
  if (stage != stage_ && of_ == Of::Stage) {
    begin_ = now;
    last_tenth_ = 0;
  }
  stage_ = stage;
  const double since_shown = std::chrono::duration<double>(now - last_shown_).count();
  const std::string left = timeLeft(std::chrono::duration<double>(now - begin_).count(), fraction);
  const int tenth = static_cast<int>(fraction * 10.0);
  if (mode_ == Mode::Bar && (since_shown >= kBarPeriod || (bar_visible_ && fraction >= 1.0))) {
    showBar(fraction, left);
    bar_visible_ = true;
    last_shown_ = now;
  } else if ((mode_ == Mode::Lines && tenth > last_tenth_) || (mode_ >= Mode::Lines && since_shown >= kLinePeriod)) {
    std::fputs((stage + " " + std::to_string(static_cast<int>(fraction * 100.0)) + " %" + left + "\n").c_str(), stderr);
    last_tenth_ = tenth;
    last_shown_ = now;
  }
  return true;
}

void
Progress::showBar(double fraction, const std::string& left) const
{
  const auto filled = static_cast<std::size_t>(fraction * kBarWidth);
  const std::string bar = std::string(filled, '#') + std::string(kBarWidth - filled, '-');
  const std::string percent = std::to_string(static_cast<int>(fraction * 100.0));
  // "\r" and "erase to the end of the line": only a terminal, or a user who asked for it, gets to see them.
  std::fputs(("\r" + stage_ + " [" + bar + "] " + percent + " %" + left + "\033[K").c_str(), stderr);
}

void
Progress::clear()
{
  if (bar_visible_)
    std::fputs("\r\033[K", stderr);
  bar_visible_ = false;
}

} // namespace pcl_gpf
