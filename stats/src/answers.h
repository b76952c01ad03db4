// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#pragma once

#include <map>

#include <stats/figures.h>
#include <stats/study.h>

#include "order_strata.h"

namespace stats {

/// The answers of the runs that count, put together by a key of each trial.
template <typename Key, typename Order = std::less<Key>>
class AnswersByKey {
public:
    /// Count one participant's trial under the key; its participant's trials come one after the other.
    void add(const Key& key, const Run& run, const Trial& trial) {
        Entry& entry = entries_[key];
        if (!trial.reference_chosen) {
            return;
        }
        const std::int64_t reference = *trial.reference_chosen ? 1 : 0;
        if (entry.last != &run) {
            entry.close_participant();
            entry.answers.participants.push_back({});
            entry.last = &run;
        }
        entry.strata.add(trial);
        Answers& answers = entry.answers;
        for (Tally* tally :
             {&answers.tally, &answers.participants.back(),
              trial.reference_first ? &answers.order.reference_first : &answers.order.reference_second}) {
            ++tally->n;
            tally->reference_chosen += reference;
        }
        if (trial.response_time_s) {
            answers.response_times_s.push_back(*trial.response_time_s);
        }
    }

    std::vector<Key> keys() const {
        std::vector<Key> result;
        for (const auto& [key, entry] : entries_) {
            result.push_back(key);
        }
        return result;
    }

    std::vector<Answers> answers() const {
        std::vector<Answers> result;
        for (const auto& [key, entry] : entries_) {
            Entry whole = entry;
            whole.close_participant();
            result.push_back(std::move(whole.answers));
        }
        return result;
    }

private:
    struct Entry {
        Answers answers;
        const Run* last = nullptr;
        OrderStrata strata; ///< of the last participant

        void close_participant() {
            if (last != nullptr) {
                answers.first_interval.push_back(first_interval(strata.tallies()));
                strata = {};
            }
        }
    };
    std::map<Key, Entry, Order> entries_;
};

} // namespace stats
