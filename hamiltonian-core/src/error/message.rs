//! The messages of [`Error`], in the order of its variants.

use super::Error;
use super::words::{DerivativePart, Known, Lane, Number, Numbers, StartRemedy, Within};
use core::fmt::{self, Display, Formatter};

impl Display for Error {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Step { step } => write!(
                f,
                "a step must be finite and not zero, found {}",
                Number(*step)
            ),
            Self::Shape {
                name,
                expected,
                found,
            } => write!(f, "`{name}` must have {expected} components, found {found}"),
            Self::Extent {
                name,
                axis,
                expected,
                found,
            } => write!(
                f,
                "axis {axis} of `{name}` must have the extent {expected}, found {found}"
            ),
            Self::Row {
                name,
                expected,
                found,
            } => write!(f, "`{name}` must have {expected} elements, found {found}"),
            Self::Memory { name } => write!(
                f,
                "`{name}` does not fit into memory: the sizes are too large"
            ),
            Self::Index {
                index,
                reached,
                extent,
            } => write!(
                f,
                "`{index}` reaches {reached}, but the extent is {extent}: the sizes do not fit"
            ),
            Self::Range { range, first } => write!(
                f,
                "`{range}` begins at {first}, but ranges begin at 0 or above: the sizes do not fit"
            ),
            Self::Start { clock, time, q, p } => write!(
                f,
                "the start is not finite: {clock} = {}, q = {}, p = {}",
                Number(*time),
                Numbers(q),
                Numbers(p)
            ),
            Self::Values {
                name,
                derivative,
                value,
                lane,
                parameter,
                clock,
                time,
                q,
                p,
            } => write!(
                f,
                "{}{name} is {}{} at the start {clock} = {}, q = {}, p = {}: {}",
                DerivativePart(*derivative),
                Number(*value),
                Lane(*lane),
                Number(*time),
                Numbers(q),
                Numbers(p),
                StartRemedy(parameter, *derivative)
            ),
            Self::Parameter { name } => {
                write!(f, "the parameter `{name}` is NaN, and must be a number")
            }
            Self::NoSteps => f.write_str(
                "indicators of chaos are means over steps: the number of steps must be at least 1, \
                 found 0",
            ),
            Self::Shell {
                momentum,
                given,
                due,
            } => write!(
                f,
                "the start is not on the shell H = 0: `{momentum}` is {} and must be {}; the \
                 methods `on_shell` and `from_declared` set it",
                Number(*given),
                Number(*due)
            ),
            Self::Monitor { value } => write!(
                f,
                "the monitor function is {} at the start, and must be positive",
                Number(*value)
            ),
            Self::MonitorOfMomenta { scheme } => write!(
                f,
                "the monitor function depends on momenta, and `{scheme}` asks for one of \
                 coordinates alone: `Gauss` and other schemes that ask for no structure take any"
            ),
            Self::Jumps { scheme, system } => write!(
                f,
                "`{system}` jumps in time, and `{scheme}` evaluates what jumps at the ends of steps or outside of \
                 them: use `Gauss` or `ImplicitMidpoint`, which evaluate it inside, or, if a piece of H does not \
                 jump, `StormerVerlet`, `BlanesMoan4` or another splitting; let steps end at the jumps"
            ),
            Self::Timed { name, system } => write!(
                f,
                "the monitor `{name}` of `{system}` depends on time: only a definition with \
                 `dt = …*ds` may have time in its monitor function"
            ),
            Self::Unknown {
                name,
                system,
                known,
            } => write!(
                f,
                "`{system}` declares no monitor, invariant or event `{name}`{}",
                Known("it declares", known)
            ),
            Self::NotFinite {
                step,
                energy: Some(energy),
                lane,
                clock,
                time,
                q,
                p,
                ..
            } => write!(
                f,
                "step {step} led to a state at which H is {energy}{}: {clock} = {}, q = {}, p = {}; \
                 end the run before it leaves the domain of H, or take shorter steps if the orbit \
                 stays inside",
                Lane(*lane),
                Number(*time),
                Numbers(q),
                Numbers(p)
            ),
            Self::NotFinite {
                step,
                energy: None,
                piece,
                lane,
                clock,
                time,
                q,
                p,
            } => write!(
                f,
                "step {step} led to a state that is not finite{}{}: {clock} = {}, q = {}, p = {}",
                Within(*piece),
                Lane(*lane),
                Number(*time),
                Numbers(q),
                Numbers(p)
            ),
            Self::Solve {
                step,
                lane,
                clock,
                time,
                residual,
                iterations,
            } => write!(
                f,
                "step {step} from {clock} = {} was not solved{}: residual {residual:e} after \
                 {iterations} iterations; a shorter step, or more iterations, may solve it",
                Number(*time),
                Lane(*lane)
            ),
            Self::Stationary {
                time,
                step,
                residual,
                iterations,
            } => write!(
                f,
                "no stationary path of a step of {} from t = {} was found: residual {residual:e} \
                 after {iterations} iterations; ends nearer to each other, or a shorter step, may \
                 have one",
                Number(*step),
                Number(*time)
            ),
            Self::OffGrid {
                clock,
                target,
                before,
                after,
            } => write!(
                f,
                "{clock} = {} is no whole number of steps ahead: the nearest times are {} and {}; \
                 `advance_until` goes to any time",
                Number(*target),
                Number(*before),
                Number(*after)
            ),
            Self::Unreachable { clock, target } => write!(
                f,
                "{clock} = {} cannot be reached: give a finite time, less than 2^53 steps ahead",
                Number(*target)
            ),
            Self::Behind { clock, target, now } => write!(
                f,
                "{clock} = {} lies behind the run, which is at {clock} = {}: a step of the other \
                 sign leads there",
                Number(*target),
                Number(*now)
            ),
            Self::OtherTime { clock, given, now } => write!(
                f,
                "the new state is at {clock} = {}, the run at {clock} = {}: a change keeps the time, give the state \
                 that of the run, `state.at(run.state().t)`",
                Number(*given),
                Number(*now)
            ),
            Self::Uneven => {
                f.write_str("steps of this scheme vary in time: `advance_until` goes to any time")
            }
            Self::Far {
                clock,
                target,
                from,
                to,
            } => write!(
                f,
                "{clock} = {} is more than one step from the present: choose a time from {} \
                 to {}",
                Number(*target),
                Number(*from),
                Number(*to)
            ),
            Self::Event { name, reason } => {
                write!(f, "the event `{name}` cannot be located: {reason}")
            }
            Self::Member { index, error } => write!(f, "member {index}: {error}"),
            Self::NoMembers => f.write_str("an ensemble has at least one member, found 0"),
            Self::NoEnd => f.write_str(
                "the members of the sweep have no end\n\
                 help: give them one: `.until(t)`, `.steps(n)`, or at least one time of \
                 `.record_at(…)`",
            ),
            Self::Apart { reason } => write!(
                f,
                "no number of steps leads all members to one time, since {reason}; a `Sweep` ends \
                 each at its time"
            ),
            Self::OtherSizes { system } => write!(
                f,
                "`{system}` has other sizes or functions than in member 0: members of one ensemble \
                 have the same"
            ),
            Self::Before { message } => write!(f, "{message} (before the ensemble was saved)"),
            Self::Cancelled { done, of } => {
                write!(f, "the sweep was cancelled after {done} of {of} members")
            }
            Self::Panicked { message } => write!(f, "a closure panicked: {message}"),
            Self::Checkpoint(error) => error.fmt(f),
            Self::Table(error) => error.fmt(f),
            Self::Knots(error) => error.fmt(f),
            Self::Shard(error) => error.fmt(f),
            #[cfg(feature = "std")]
            Self::Store(error) => error.fmt(f),
            #[cfg(feature = "std")]
            Self::Io { message, .. } => write!(f, "{message}"),
            Self::Component { index, count } => {
                write!(f, "there is no component {index}: there are {count}")
            }
            Self::Deviations { most, found } => write!(
                f,
                "the number of deviations must be from 1 to {most}, found {found}"
            ),
            Self::Observable { index, count } => write!(
                f,
                "there is no observable {index}: the system declares {count}"
            ),
            Self::NoPeriodicOrbit { gap, period } => write!(
                f,
                "no periodic orbit was found: the best start, with the period {period}, misses its \
                 conditions by {gap:e}\n\
                 help: give a nearer guess, or more steps"
            ),
            Self::PointOrbit { distance } => write!(
                f,
                "the search for a periodic orbit tends to an equilibrium, at a distance of {distance:e} from the guess\n\
                 help: give the energy instead of the period (`Closing::OfEnergy`), or a guess on a larger orbit"
            ),
            Self::FarOrbit {
                distance,
                widths,
                period,
            } => write!(
                f,
                "the periodic orbit that was found, with the period {period}, starts at a distance of {distance:e} from \
                 the guess, {widths:.1} times the width of the guessed orbit\n\
                 help: give a nearer guess, more arcs or a symmetry; `with_reach` accepts orbits that are further away"
            ),
            Self::Symmetry { change: None } => write!(
                f,
                "a symmetry needs a sign, 1 or -1, for each coordinate, then for each momentum; those of a coordinate and \
                 its momentum must differ"
            ),
            Self::Symmetry {
                change: Some(change),
            } => write!(
                f,
                "H changes by {change:e} under the symmetry, at a point of the guess\n\
                 help: give the signs of a symmetry that turns time round, such as `&[1, -1, -1, 1]` for \
                 H(x, -y, -p_x, p_y) = H(x, y, p_x, p_y)"
            ),
            Self::NoMomentum {
                name,
                index,
                energy,
                reached,
                at,
            } => write!(
                f,
                "no `{name}` (component {index}) gives H = {}: the nearest H found is {}, at {}",
                Number(*energy),
                Number(*reached),
                Number(*at)
            ),
            Self::NoCrossing {
                event,
                name,
                index,
                from,
                value,
            } => write!(
                f,
                "`{event}` changes sign for no `{name}` (component {index}): it is {} at {}",
                Number(*value),
                Number(*from)
            ),
            Self::Masses { body, sum } => write!(
                f,
                "the masses of the bodies up to {body} add up to {}",
                Number(*sum)
            ),
        }
    }
}
