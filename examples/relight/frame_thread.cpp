#include "frame_thread.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <oneapi/tbb/task_arena.h>

namespace relight {

namespace {

double pixels_of(const FrameState& state) { return static_cast<double>(state.width) * state.height; }

}  // namespace

/// Makes a task group known as that of the picture under way, as long as this object lives.
class FrameThread::UnderWay {
public:
    /// pre: the thread's mutex is held; it is not held when this object is destroyed.
    UnderWay(FrameThread& thread, tbb::task_group& group, int divisor, bool is_refining) : thread_(thread) {
        thread.group_ = &group;
        thread.is_refining_ = is_refining;
        thread.divisor_ = divisor;
        thread.since_begin_ = render::Stopwatch();
    }
    ~UnderWay() {
        const std::lock_guard lock(thread_.mutex_);
        thread_.group_ = nullptr;
    }
    UnderWay(const UnderWay&) = delete;
    UnderWay& operator=(const UnderWay&) = delete;

private:
    FrameThread& thread_;
};

FrameThread::FrameThread(FrameSource& source, int threads, std::function<void()> ready, const Pace& pace)
    : source_(source), ready_(std::move(ready)), pace_(pace), thread_([this, threads] { run(threads); }) {}

FrameThread::~FrameThread() {
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
        if (group_) group_->cancel();
    }
    changed_.notify_one();
    thread_.join();
}

void FrameThread::show(const ShownState& state) {
    {
        const std::lock_guard lock(mutex_);
        if (wanted_ == state) return;
        const bool is_other_frame = !wanted_ || !(wanted_->frame == state.frame);
        wanted_ = state;
        if (group_ && is_other_frame && is_dispensable()) group_->cancel();
    }
    changed_.notify_one();
}

bool FrameThread::is_dispensable() const {
    return is_refining_ || (divisor_ == 1 && since_begin_.seconds() > Pace::most_seconds);
}

std::shared_ptr<const ShownFrame> FrameThread::take() {
    const std::lock_guard lock(mutex_);
    if (problem_) std::rethrow_exception(std::exchange(problem_, nullptr));
    return std::exchange(frame_, nullptr);
}

void FrameThread::run(int threads) {
    tbb::task_arena arena(threads);
    std::optional<Made> made;
    std::optional<ShownState> shown;
    for (;;) {
        ShownState wanted;
        {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [&] {
                const bool is_refined = made && made->divisor == 1;
                return ends_ || (wanted_ && !(shown == wanted_ && is_refined));
            });
            if (ends_) return;
            wanted = *wanted_;
        }
        try {
            const bool has_moved = !made || !(made->state == wanted.frame);
            const bool is_only_exposed = !has_moved && !(shown == wanted);
            if (!is_only_exposed) {
                const int divisor = has_moved ? pace_.divisor(pixels_of(wanted.frame)) : Pace::finer(made->divisor);
                std::optional<Made> next;
                arena.execute([&] { next = make(wanted.frame, divisor, !has_moved); });
                if (!next) continue;
                made = std::move(next);
            }
            auto frame = developed(wanted, *made);
            shown = wanted;
            const std::lock_guard lock(mutex_);
            frame_ = std::move(frame);
        } catch (...) {
            const std::lock_guard lock(mutex_);
            problem_ = std::current_exception();
            ends_ = true;
        }
        ready_();
    }
}

std::optional<FrameThread::Made> FrameThread::make(const FrameState& state, int divisor, bool is_refining) {
    tbb::task_group group;
    std::optional<UnderWay> under_way;
    {
        const std::lock_guard lock(mutex_);
        // What has changed meanwhile has found nothing to cancel.
        if (ends_ || (is_refining && !(wanted_->frame == state))) return std::nullopt;
        under_way.emplace(*this, group, divisor, is_refining);
    }
    FrameState coarse = state;
    coarse.width = std::max(1, (state.width + divisor - 1) / divisor);
    coarse.height = std::max(1, (state.height + divisor - 1) / divisor);
    std::optional<render::Picture> picture;
    std::exception_ptr problem;
    group.run_and_wait([&] {
        try {
            picture = source_.picture(coarse);
        } catch (...) { problem = std::current_exception(); }
    });
    under_way.reset();
    const double seconds = since_begin_.seconds();
    if (problem) std::rethrow_exception(problem);
    if (!is_refining) pace_.took(pixels_of(coarse), seconds);
    if (!picture) return std::nullopt;
    return Made{state, divisor, std::make_shared<const render::Picture>(std::move(*picture)), source_.figures(),
                seconds};
}

std::shared_ptr<const ShownFrame> FrameThread::developed(const ShownState& state, const Made& made) {
    const bool is_fitted = curve_ && fits_ == state.fits;
    if (made.divisor == 1 && !is_fitted) {
        curve_ = render::tone_curve(*made.picture);
        fits_ = state.fits;
    }
    render::ToneCurve curve = curve_ ? *curve_ : render::tone_curve(*made.picture);
    curve.exposure *= std::exp2(state.exposure);
    ShownFrame frame{state, made.divisor, made.picture, {}, made.figures, made.seconds};
    frame.bytes = render::srgb_bytes(render::tone_mapped(*made.picture, curve));
    return std::make_shared<const ShownFrame>(std::move(frame));
}

}  // namespace relight
