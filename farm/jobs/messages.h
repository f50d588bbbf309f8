// Sentences for the user that wait to be fetched.
#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

namespace antipode {

class Messages {
public:
    void say(std::string sentence) {
        if (waiting_.size() < most) waiting_.push_back(std::move(sentence));
    }
    /// Says nothing where something was said under this key before.
    void sayOnce(const std::string& key, std::string sentence) {
        if (said_.insert(key).second) say(std::move(sentence));
    }
    std::vector<std::string> take() { return std::exchange(waiting_, {}); }

private:
    static constexpr size_t most = 1000;  ///< where nobody fetches them, the first ones tell what is wrong

    std::vector<std::string> waiting_;
    std::set<std::string> said_;
};

}  // namespace antipode
