// A line on the terminal that tells how far a render is.
#pragma once

#include <chrono>
#include <string_view>

namespace tessera::program {

// Shows "split  43 %  12 s left" on stderr once a second has passed, and clears it at the end of its life.
class ProgressLine {
public:
    // `frames`: how many times update()'s fraction will run from 0 to 1. Shows nothing unless `enabled` and stderr is a terminal.
    ProgressLine(bool enabled, int frames);
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    // Whether update() may show anything.
    [[nodiscard]] bool enabled() const { return enabled_; }
    // `frame` from 0; `stage` and `fraction` as tessera::Progress tells them.
    void update(int frame, std::string_view stage, double fraction);
    void clear();

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    int frames_ = 1;
    bool enabled_ = false;
    bool shown_ = false;
};

}  // namespace tessera::program
