// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <map>
#include <vector>

#include <stats/log.h>
#include <stats/order.h>
#include <stats/table.h>

namespace stats {

/// One participant's answers by condition and order.
class OrderStrata {
public:
    /// The trial needs an answer.
    void add(const Trial& trial) {
        OrderTally& stratum = by_condition_[trial.condition];
        Tally& tally = trial.reference_first ? stratum.reference_first : stratum.reference_second;
        ++tally.n;
        tally.reference_chosen += *trial.reference_chosen ? 1 : 0;
    }

    std::vector<OrderTally> tallies() const {
        std::vector<OrderTally> result;
        for (const auto& [condition, tally] : by_condition_) {
            result.push_back(tally);
        }
        return result;
    }

private:
    struct InOrder {
        bool operator()(const Condition& a, const Condition& b) const { return paper_order(a, b); }
    };
    std::map<Condition, OrderTally, InOrder> by_condition_;
};

} // namespace stats
