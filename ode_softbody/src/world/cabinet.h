#pragma once

#include <map>
#include <memory>
#include <string>

namespace ode::soft {

/// What like bodies share, by content: kept while somebody holds it.
template <class Value>
class Cabinet {
public:
    /// @param key   of all that decides it; empty: never shared
    /// @param make  called when nobody holds it
    template <class Make>
    std::shared_ptr<const Value> get(const std::string& key, Make make) {
        std::weak_ptr<const Value>& place = known_[key];
        if (!key.empty())
            if (auto shared = place.lock())
                return shared;
        auto made = std::make_shared<const Value>(make());
        place = made;
        return made;
    }

private:
    std::map<std::string, std::weak_ptr<const Value>> known_;
};

} // namespace ode::soft
