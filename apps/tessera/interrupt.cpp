// Ctrl-C: a thread waits for the signals instead of a handler, so no global state and no async-signal rules are needed.
#include "interrupt.h"

#include <array>
#include <utility>

namespace tessera::program {

namespace {

// A job in the background is started with SIGINT ignored, and nohup ignores SIGHUP: both are to stay so.
bool isIgnored(int signal) {
    struct sigaction action {};
    return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

void endProcessBy(int signal) {
    sigset_t only{};
    sigemptyset(&only);
    sigaddset(&only, signal);
    std::signal(signal, SIG_DFL);
    pthread_sigmask(SIG_UNBLOCK, &only, nullptr);
    std::raise(signal);
}

constexpr int kWakeUp = SIGUSR1;  // ends the watcher; sent to its thread alone

}  // namespace

Interrupt::Interrupt() {
    sigemptyset(&signals_);
    for (const int signal : std::array{SIGINT, SIGTERM, SIGHUP}) {
        if (!isIgnored(signal)) sigaddset(&signals_, signal);
    }
    sigset_t blocked = signals_;
    sigaddset(&blocked, kWakeUp);
    pthread_sigmask(SIG_BLOCK, &blocked, &previousMask_);
    watcher_ = std::thread([this] { watch(); });
}

Interrupt::~Interrupt() {
    ended_ = true;
    pthread_kill(watcher_.native_handle(), kWakeUp);
    watcher_.join();
    pthread_sigmask(SIG_SETMASK, &previousMask_, nullptr);
}

void Interrupt::watch() {
    sigset_t waited = signals_;
    sigaddset(&waited, kWakeUp);
    while (!ended_) {
        int signal = 0;
        if (sigwait(&waited, &signal) != 0 || signal == kWakeUp) continue;
        end(signal);
    }
}

void Interrupt::end(int signal) {
    const std::lock_guard next(next_);
    const std::lock_guard whole(files_);
    if (removeParts_) removeParts_();
    endProcessBy(signal);
}

std::unique_lock<std::mutex> Interrupt::files() {
    const std::lock_guard next(next_);
    return std::unique_lock(files_);
}

Interrupt::AtEnd::AtEnd(Interrupt& interrupt, std::function<void()> removeParts) : interrupt_(interrupt) {
    const auto whole = interrupt_.files();
    interrupt_.removeParts_ = std::move(removeParts);
}

Interrupt::AtEnd::~AtEnd() {
    const auto whole = interrupt_.files();
    interrupt_.removeParts_ = nullptr;
}

}  // namespace tessera::program
