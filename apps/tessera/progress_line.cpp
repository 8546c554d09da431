// A line on the terminal that tells how far a render is.
#include "progress_line.h"

#include "console.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>

#include <unistd.h>

namespace tessera::program {

namespace {

std::string durationText(double seconds) {
    const auto whole = static_cast<long>(std::ceil(std::min(seconds, 3.6e6)));
    if (whole < 100) return std::to_string(whole) + " s";
    if (whole < 6000) return std::to_string(whole / 60) + " min " + std::to_string(whole % 60) + " s";
    return std::to_string(whole / 3600) + " h " + std::to_string(whole / 60 % 60) + " min";
}

}  // namespace

ProgressLine::ProgressLine(bool enabled, int frames) : frames_(frames), enabled_(enabled && isatty(STDERR_FILENO) == 1) {}

ProgressLine::~ProgressLine() { clear(); }

void ProgressLine::update(int frame, std::string_view stage, double fraction) {
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
    if (!enabled_ || elapsed.count() < 1.0) return;
    const double done = std::clamp((frame + fraction) / frames_, 0.0, 1.0);
    std::string line = frames_ > 1 ? "frame " + std::to_string(frame + 1) + " of " + std::to_string(frames_) + "  " : std::string();
    line += oneLine(stage) + "  " + fixed(100.0 * done, 0) + " %";
    if (done > 0.0) line += "  " + durationText(elapsed.count() * (1.0 - done) / done) + " left";
    std::cerr << "\r" + line + "\033[K" << std::flush;
    shown_ = true;
}

void ProgressLine::clear() {
    if (shown_) std::cerr << "\r\033[K" << std::flush;
    shown_ = false;
}

}  // namespace tessera::program
