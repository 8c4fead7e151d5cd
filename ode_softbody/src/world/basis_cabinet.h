#pragma once

#include "reduced/modal_basis.h"

#include <map>
#include <memory>
#include <string>

namespace ode::soft {

/// Modal bases in use, so that like bodies share one: by content, kept while somebody holds them.
class BasisCabinet {
public:
    /// @param key   of all that decides the basis; empty: never shared
    /// @param make  called when nobody holds it
    template <class Make>
    std::shared_ptr<const ModalBasis> get(const std::string& key, Make make) {
        std::weak_ptr<const ModalBasis>& place = known_[key];
        if (!key.empty())
            if (auto shared = place.lock())
                return shared;
        auto made = std::make_shared<const ModalBasis>(make());
        place = made;
        return made;
    }

private:
    std::map<std::string, std::weak_ptr<const ModalBasis>> known_;
};

} // namespace ode::soft
