#include "client/background_writer.h"

#include <utility>

namespace antipode {

BackgroundWriter::~BackgroundWriter() { wait(); }

bool BackgroundWriter::tryWrite(std::function<void()> write) {
    if (busy()) return false;
    collect();
    inHand_ = std::async(std::launch::async, std::move(write));
    return true;
}

bool BackgroundWriter::busy() const {
    return inHand_.valid() && inHand_.wait_for(std::chrono::seconds(0)) != std::future_status::ready;
}

void BackgroundWriter::wait() { collect(); }

std::string BackgroundWriter::takeFailure() {
    if (!busy()) collect();
    return std::exchange(failure_, {});
}

void BackgroundWriter::collect() {
    if (!inHand_.valid()) return;
    try {
        inHand_.get();
    } catch (const std::exception& error) {
        failure_ = error.what();
    }
}

}  // namespace antipode
