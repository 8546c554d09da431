// Lets Ctrl-C end the program at once, whatever a driver waits for, and never within the writing of a file.
#pragma once

#include <atomic>
#include <csignal>
#include <functional>
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

    // Held while output files are being written: an interrupt waits until they are whole. Once there is one, nobody gets it any more.
    [[nodiscard]] std::unique_lock<std::mutex> files();

    // For files that take too long to be waited for: while it lives, an interrupt calls `removeParts`, which must not throw, in its own
    // thread with files() locked, before the process ends. Who writes them holds files() for a part at a time. One at a time, neither made
    // nor destroyed with files() locked.
    class AtEnd {
    public:
        AtEnd(Interrupt& interrupt, std::function<void()> removeParts);
        ~AtEnd();
        AtEnd(const AtEnd&) = delete;
        AtEnd& operator=(const AtEnd&) = delete;

    private:
        Interrupt& interrupt_;
    };

private:
    void watch();
    void end(int signal);

    sigset_t signals_{};
    sigset_t previousMask_{};
    std::mutex next_;  // locked before files_: an interrupt keeps it, so that who writes part after part cannot overtake it
    std::mutex files_;
    std::function<void()> removeParts_;  // read and set with files_ locked
    std::atomic<bool> ended_ = false;
    std::thread watcher_;
};

}  // namespace tessera::program
