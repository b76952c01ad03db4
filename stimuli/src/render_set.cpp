// SPDX-FileCopyrightText: 2026 The skin2afc authors
// SPDX-License-Identifier: MIT

#include <stimuli/render_set.h>

#include <algorithm>
#include <chrono>
#include <deque>
#include <future>
#include <set>

#include <fmt/format.h>

#include <renderer/gl/context.h>
#include <renderer/reference/reference.h>
#include <stimuli/setup.h>
#include <support/error.h>
#include <support/file.h>
#include <support/progress.h>

#include "contact_sheet.h"
#include "design.h"
#include "manifest.h"
#include "picture_file.h"
#include "reason.h"
#include "recipe.h"

namespace stimuli {
namespace {

namespace fs = std::filesystem;
namespace passes = renderer::passes;
namespace scene = renderer::scene;
using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

// Frames that wait to be encoded; each holds up to 32 MB at the size of the paper's stimuli.
constexpr std::size_t longest_queue = 3;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// An image that has been rendered and is being encoded.
struct Encoding {
    std::size_t item;
    std::future<double> seconds; ///< that it took
};

/// One run of the command.
class SetRenderer {
public:
    explicit SetRenderer(const SetRequest& request)
        : request_(request), protocol_(study::read_protocol(request.protocol_file)),
          selection_(selection(request.only, request.shard, protocol_)),
          selected_(selected(selection_, protocol_)) {}

    SetReport run() {
        const auto start = Clock::now();
        load();
        report_.driver = renderer::gl::driver_info().renderer;
        report_.model = model_.name;
        manifest_.emplace(request_.out, header());
        check_folder();
        plan();
        prepare();
        support::make_writable_folder(request_.out);
        manifest_->keep_only(recipe_digests_);
        render();
        finish();
        report_.seconds = seconds_since(start);
        return std::move(report_);
    }

private:
    template <typename Work>
    void timed(const char* what, const Work& work) {
        const auto start = Clock::now();
        work();
        add_cost(what, seconds_since(start));
    }
    void add_cost(const char* what, double seconds) {
        report_.costs[what].seconds += seconds;
        ++report_.costs[what].runs;
    }

    /// Load the model on another thread while this one makes the context, which is its own from then on.
    void load() {
        auto loading = std::async(std::launch::async, [this] {
            const auto start = Clock::now();
            model_ = load_model(protocol_, request_.model_file);
            return seconds_since(start);
        });
        timed("making a context", [&] { context_.emplace(renderer::gl::Context::headless()); });
        add_cost("loading the model", loading.get());
    }

    Json header() const {
        return {{"program", "skin2afc"},
                {"protocol", {{"name", protocol_.name}, {"digest", protocol_.digest}}},
                {"model", {{"name", model_.name}, {"digest", model_.digest}}},
                {"renderer", report_.driver}};
    }

    /// Rendering a part of the set with another model would drop the rest of the folder's images: more likely
    /// a forgotten --model than a wish.
    void check_folder() const {
        const bool part = !request_.only.empty() || !request_.shard.empty();
        for (const auto& [name, entry] : manifest_->entries()) {
            const Json& parameters = entry["parameters"];
            const bool same = parameters.contains("model") && parameters["model"] == model_.digest;
            if (part && !same && !request_.force) {
                throw support::input_error(
                    "{}: expected images of the model {}, found {} of another model; give --model, "
                    "another folder, or --force",
                    request_.out.string(), model_.name, name);
            }
        }
    }

    /// A protocol that does not list the reference has its images if they are asked for by name, or already
    /// there.
    study::Protocol protocol_with_reference() const {
        study::Protocol protocol = protocol_;
        const auto entries = manifest_->entries();
        const bool there = std::any_of(entries.begin(), entries.end(), [](const auto& entry) {
            return entry.second.value("shader", "") == reference_shader;
        });
        if (!listed(reference_shader) && (asked_for(reference_shader) || there)) {
            protocol.shaders.emplace_back(reference_shader);
        }
        return protocol;
    }
    bool listed(const std::string& shader) const {
        return std::find(protocol_.shaders.begin(), protocol_.shaders.end(), shader) !=
               protocol_.shaders.end();
    }
    bool asked_for(const std::string& shader) const {
        return std::find(selection_.shaders.begin(), selection_.shaders.end(), shader) !=
               selection_.shaders.end();
    }

    /// Decide for each image whether it must be rendered.
    void plan() {
        const scene::HeadFrame head = head_frame(protocol_, model_);
        items_ = design(protocol_with_reference());
        const auto entries = manifest_->entries();
        for (const Item& item : items_) {
            recipes_.push_back(recipe(item, protocol_, model_, head, report_.driver));
            recipe_digests_[item.name()] = recipes_.back().digest;
            report_.outcomes.push_back(
                {item.name(), reason(item, recipes_.back(), entries), false, 0, {}, {}, {}, {}});
        }
    }

    /// Meet all that the renderer could refuse, before anything is written.
    void prepare() {
        for (std::size_t i = 0; i < items_.size(); ++i) {
            if (!to_render(report_.outcomes[i])) {
                continue;
            }
            if (!recipes_[i].shader) {
                if (!reference_) {
                    reference_.emplace(model_, reference_look(protocol_), reference_settings(protocol_));
                }
            } else {
                if (!pipeline_) {
                    pipeline_.emplace(model_, look(protocol_), methods(protocol_), request_.switches);
                }
                pipeline_->prepare(*recipes_[i].shader, recipes_[i].camera, recipes_[i].light);
            }
        }
    }

    /// Why an image has to be rendered; up_to_date or not_selected if it has not.
    std::string reason(const Item& item, const Recipe& recipe,
                       const std::map<std::string, Json>& entries) const {
        if (!selected_.contains(item.name())) {
            return not_selected;
        }
        const auto found = entries.find(item.name());
        return reason_to_render(item.name(), recipe, found == entries.end() ? nullptr : &found->second,
                                request_);
    }

    static bool to_render(const Outcome& outcome) {
        return outcome.reason != up_to_date && outcome.reason != not_selected;
    }

    void render() {
        const auto count = static_cast<std::size_t>(
            std::count_if(report_.outcomes.begin(), report_.outcomes.end(), to_render));
        if (count == 0) {
            return;
        }
        sheet_.emplace(protocol_);
        if (!request_.quiet) {
            progress_.emplace("rendering", count);
        }
        for (std::size_t i = 0; i < items_.size(); ++i) {
            if (to_render(report_.outcomes[i])) {
                report_.most_waiting = std::max(report_.most_waiting, queue_.size());
                encode(i, rendered(i));
                drain(request_.overlap ? longest_queue : 0);
            }
        }
        timed("waiting for files", [&] { drain(0); });
        if (pipeline_) {
            for (const auto& [node, cost] : pipeline_->costs()) {
                report_.costs[node] = cost;
            }
            report_.warnings = pipeline_->warnings();
        }
        if (reference_) {
            for (const auto& [stage, seconds] : reference_->seconds()) {
                report_.costs[stage] = {seconds, references_rendered_};
            }
        }
        progress_.reset();
    }

    /// Render one image and note what it took.
    scene::Frame rendered(std::size_t i) {
        const auto start = Clock::now();
        const Recipe& recipe = recipes_[i];
        scene::Frame frame =
            recipe.shader ? pipeline_->render(*recipe.shader, recipe.camera, recipe.light, request_.exr)
                          : reference_->render(recipe.camera, recipe.light, request_.exr);
        references_rendered_ += recipe.shader ? 0 : 1;
        Outcome& outcome = report_.outcomes[i];
        outcome.rendered = true;
        outcome.milliseconds = 1000 * seconds_since(start);
        outcome.passes_run = frame.passes_run;
        outcome.passes_reused = frame.passes_reused;
        outcome.passes_skipped = frame.passes_skipped;
        outcome.counts = frame.counts;
        return frame;
    }

    /// Write the image's files and enter them into the manifest, on another thread while the next image is
    /// rendered.
    void encode(std::size_t i, scene::Frame frame) {
        auto work = [this, name = items_[i].name(),
                     entry = manifest_entry(items_[i], recipes_[i], report_.outcomes[i]),
                     frame = std::move(frame)]() mutable {
            const auto start = Clock::now();
            const std::string stem = (request_.out / name).string();
            if (request_.exr) {
                entry["exr_sha256"] = write_exr(stem + ".exr", frame);
            } else {
                fs::remove(stem + ".exr"); // of another picture than the one to be written
            }
            entry["sha256"] = write_png(stem + ".png", frame);
            manifest_->add(name, entry);
            sheet_->paste(name, frame.srgb.data(), 3);
            return seconds_since(start);
        };
        queue_.push_back({i, std::async(std::launch::async, std::move(work))});
    }

    /// Wait until at most `longest` images are left in the queue.
    void drain(std::size_t longest) {
        while (queue_.size() > longest) {
            Encoding encoding = std::move(queue_.front());
            queue_.pop_front();
            add_cost(request_.overlap ? "encoding (beside rendering)" : "encoding", encoding.seconds.get());
            if (progress_) {
                progress_->step(items_[encoding.item].name());
            }
        }
    }

    /// Once the folder holds the whole set, draw its contact sheet, unless it shows the same already.
    void finish() {
        const auto entries = manifest_->entries();
        for (const Item& item : items_) {
            const bool there =
                entries.contains(item.name()) && fs::exists(request_.out / (item.name() + ".png"));
            report_.missing += there || !listed(item.shader) ? 0 : 1;
        }
        if (report_.missing > 0) {
            return;
        }
        std::string inputs;
        for (const std::string& shader : protocol_.shaders) {
            for (const Item& item : items_) {
                if (item.shader == shader) {
                    inputs += item.name() + entries.at(item.name())["sha256"].get<std::string>();
                }
            }
        }
        inputs = support::sha256(inputs);
        if (manifest_->contact_sheet_inputs() != inputs || !fs::exists(request_.out / "contact_sheet.png")) {
            timed("contact sheet", [&] {
                if (!sheet_) {
                    sheet_.emplace(protocol_);
                }
                sheet_->write(request_.out);
            });
            manifest_->note_contact_sheet(inputs);
        }
    }

    const SetRequest& request_;
    study::Protocol protocol_;
    Selection selection_;
    std::set<std::string> selected_; // names
    scene::Model model_;
    std::optional<renderer::gl::Context> context_;
    std::vector<Item> items_;
    std::vector<Recipe> recipes_; // as items_
    std::map<std::string, std::string> recipe_digests_;
    std::optional<passes::Pipeline> pipeline_;
    std::optional<renderer::reference::Reference> reference_;
    int references_rendered_ = 0;
    std::optional<support::Progress> progress_;
    SetReport report_;
    std::optional<Manifest> manifest_;
    std::optional<ContactSheet> sheet_;
    std::deque<Encoding> queue_; // its threads use all that stands above
};

} // namespace

SetReport render_set(const SetRequest& request) { return SetRenderer(request).run(); }

} // namespace stimuli
