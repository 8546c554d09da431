// Lets Ctrl-C end the program at once, whatever a driver waits for, and never within the writing of a file.
#pragma once

#include <atomic>
#include <csignal>
#include <mutex>
#include <thread>

namespace tessera::program {

// While it lives, SIGINT, SIGTERM and SIGHUP (those that are not ignored) are taken by a thread of its own, which ends
// the process by the same signal as soon as nobody holds a lock of files(). Make it before other threads: they inherit
// the blocked signals.
class Interrupt {
public:
    Interrupt();
    ~Interrupt();
    Interrupt(const Interrupt&) = delete;
    Interrupt& operator=(const Interrupt&) = delete;

    // Held while output files are being written: an interrupt waits until they are whole.
    [[nodiscard]] std::unique_lock<std::mutex> files() { return std::unique_lock(files_); }

private:
    void watch();

    sigset_t signals_{};
    sigset_t previousMask_{};
    std::mutex files_;
    std::atomic<bool> ended_ = false;
    std::thread watcher_;
};

}  // namespace tessera::program
