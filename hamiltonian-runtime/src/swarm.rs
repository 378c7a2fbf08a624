//! Ensembles whose scheme has a name.
//!
//! Input: systems, the name of a scheme, the starts of all members in two lists. Output: [`Swarm`]. Invariant: it is core's
//! `Ensemble` without fused products, so each member has the bits of its [`Run`](crate::Run).

use crate::error::RunError;
use crate::many::Many;
use crate::run::FlatState;
use crate::schemes::many;
use crate::system::RuntimeSystem;
use crate::watching::Hook;
use hamiltonian_core::errors::{StartError, SweepError};
use hamiltonian_core::schemes::author::{Clock, Listed};
use hamiltonian_core::{Checkpoint, Ensemble, Error, Member, State, Unfused};
use std::fmt::{self, Debug, Formatter};
use std::time::{Duration, Instant};

/// Many members of one definition, which differ in their starts and parameters, with one scheme that is named by a text.
///
/// Members are computed in the lanes of packs and on all cores. Each has the bits of its single [`Run`](crate::Run). A
/// member that fails keeps its error, and the others continue.
///
/// ```
/// use hamiltonian_runtime::{Definition, Swarm};
///
/// let pendulum = Definition::parse("struct Pendulum { l = 1.0 } H(theta; p) = p^2/(2*l^2) - l*cos(theta)", "text")?;
/// // A parameter with a value for each member: a system for each.
/// let systems = (0..100).map(|member| pendulum.system([("l", 1.0 + 0.01 * member as f64)]));
/// let systems = systems.collect::<Result<Vec<_>, _>>()?;
/// let mut swarm = Swarm::new(&systems, "StormerVerlet", &[0.5; 100], &[0.0; 100], 0.0, 0.01)?;
/// swarm.advance_to(10.0)?;
/// let states = swarm.states();
/// assert_eq!(states.q.len(), 100);
/// assert!(states.errors.is_empty());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Swarm {
    members: Ensemble<RuntimeSystem, Many, (), Unfused>,
    /// The name of the scheme.
    scheme: String,
    /// The number of members, and of coordinates of one.
    of: [usize; 2],
    clock: Clock<f64>,
    step: f64,
    hook: Hook,
}

/// The states of all members of a [`Swarm`].
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct MemberStates {
    /// The time of each member.
    pub t: Vec<f64>,
    /// The coordinates, those of a member together; NaN for one that failed.
    pub q: Vec<f64>,
    /// The momenta.
    pub p: Vec<f64>,
    /// The members that failed, with their errors.
    pub errors: Vec<(usize, Error)>,
}

impl Swarm {
    /// Creates members with the step size `step`, from the starts `q` and `p`, those of a member together, at the time `t`.
    /// `systems` is one for all members, or one for each.
    ///
    /// A member that cannot start has its error in [`states`](Swarm::states).
    ///
    /// # Errors
    /// [`RunError::UnknownScheme`], [`RunError::SingleRuns`]; [`RunError::Length`] if the lists do not have the numbers of all members;
    /// [`SweepError::NoMembers`], [`StartError::Step`](hamiltonian_core::errors::StartError::Step), and
    /// [`StartError::Structure`](hamiltonian_core::errors::StartError::Structure).
    pub fn new(
        systems: &[RuntimeSystem],
        scheme: &str,
        q: &[f64],
        p: &[f64],
        t: f64,
        step: f64,
    ) -> Result<Swarm, RunError> {
        Self::of(systems, scheme, [q, p], t, (step, None))
    }

    /// Returns the members as bytes, for [`resume`](Swarm::resume): core's [`Checkpoint`] after a line with the scheme and the
    /// step.
    #[must_use]
    pub fn save(&self) -> Vec<u8> {
        let mut bytes = format!("ensemble {} {:e}\n", self.scheme, self.step).into_bytes();
        bytes.extend(self.members.checkpoint().to_bytes());
        bytes
    }

    /// Resumes saved members with the same bits, from the systems and the starts of [`new`](Swarm::new). Call
    /// [`with_threads`](Swarm::with_threads) and [`with_cancel`](Swarm::with_cancel) again.
    ///
    /// ```
    /// use hamiltonian_runtime::{Definition, Swarm, Values};
    ///
    /// let spring = [Definition::parse("H(x; p) = p^2/2 + x^2/2", "spring.txt")?.system(Values::new())?];
    /// let (q, p) = ([1.0, 2.0], [0.0; 2]);
    /// let mut swarm = Swarm::new(&spring, "BlanesMoan4", &q, &p, 0.0, 0.1)?;
    /// swarm.advance(10)?;
    /// let mut again = Swarm::resume(&spring, &q, &p, 0.0, &swarm.save())?;
    /// swarm.advance(10)?;
    /// again.advance(10)?;
    /// assert_eq!((swarm.steps(), swarm.states()), (again.steps(), again.states()));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`RunError::NotSaved`], those of [`new`](Swarm::new), and those of
    /// [`Ensemble::resume_reproducible`].
    pub fn resume(
        systems: &[RuntimeSystem],
        q: &[f64],
        p: &[f64],
        t: f64,
        bytes: &[u8],
    ) -> Result<Swarm, RunError> {
        let end = bytes.iter().position(|byte| *byte == b'\n');
        let (line, rest) = bytes.split_at(end.ok_or(RunError::NotSaved)?);
        let line = std::str::from_utf8(line).map_err(|_| RunError::NotSaved)?;
        let words = line.strip_prefix("ensemble ");
        let (scheme, step) = words
            .and_then(|words| words.rsplit_once(' '))
            .ok_or(RunError::NotSaved)?;
        let step = step.parse().map_err(|_| RunError::NotSaved)?;
        let saved = Checkpoint::from_bytes(&rest[1..])?;
        Self::of(systems, scheme, [q, p], t, (step, Some(saved)))
    }

    /// Members at their starts, or saved ones.
    fn of(
        systems: &[RuntimeSystem],
        scheme: &str,
        [q, p]: [&[f64]; 2],
        t: f64,
        (step, saved): (f64, Option<Checkpoint>),
    ) -> Result<Swarm, RunError> {
        let starts = Starts { systems, q, p, t };
        let (count, width) = (starts.count()?, systems[0].degrees_of_freedom());
        let of = many(scheme)?;
        let duration = f64::from(of.entry().duration);
        let make = |member: Member| starts.member(member.index);
        let members = match saved {
            None => Ensemble::new(count, make, of, step)?.reproducible(),
            Some(saved) => Ensemble::resume_reproducible(count, make, of, saved)?,
        };
        // A structure that one member lacks, all lack.
        if let Some(Err(Error::Sweep(SweepError::Member { error, .. }))) = members.state_of(0)
            && let Error::Start(StartError::Structure { .. }) = *error
        {
            return Err((*error).into());
        }
        let clock = Clock::new(starts.t, step * duration);
        Ok(Swarm {
            members,
            scheme: scheme.to_owned(),
            of: [count, width],
            clock,
            step,
            hook: Hook::default(),
        })
    }

    /// Sets the number of threads (0 counts as 1); by default as many as the machine runs at once. The results do not
    /// depend on it.
    #[must_use]
    pub fn with_threads(mut self, threads: usize) -> Swarm {
        self.members = self.members.with_threads(threads);
        self
    }

    /// Asks `cancel` about ten times a second whether to stop: a call that advances the members then returns
    /// [`RunError::Interrupted`], and all members stand at one number of steps.
    #[must_use]
    pub fn with_cancel(self, cancel: impl Fn() -> bool + Send + Sync + 'static) -> Swarm {
        self.hook.set(cancel);
        self
    }

    /// Makes `steps` steps of every member that has not failed.
    ///
    /// # Errors
    /// [`RunError::Interrupted`] alone: the error of a member is in its place.
    pub fn advance(&mut self, steps: u64) -> Result<(), RunError> {
        if self.hook.is_set() {
            return self.advance_watched(steps, &mut |_| {});
        }
        self.members.advance(steps);
        Ok(())
    }

    /// Makes `steps` steps as [`advance`](Swarm::advance) does, and calls `progress` about ten times a second, and at the end,
    /// with the number of steps made in this call.
    ///
    /// # Errors
    /// [`RunError::Interrupted`].
    pub fn advance_watched(
        &mut self,
        steps: u64,
        progress: &mut dyn FnMut(u64),
    ) -> Result<(), RunError> {
        /// The shortest time between two questions.
        const SOON: Duration = Duration::from_millis(100);
        let (mut made, mut block) = (0, 1);
        while made < steps {
            let some = block.min(steps - made);
            let begin = Instant::now();
            self.members.advance(some);
            made += some;
            // Members are loaded and stored for each block, which takes as long as some 60 steps of a pendulum: it is as long
            // as the time allows.
            block = match begin.elapsed() {
                time if time < SOON / 4 => block.saturating_mul(4),
                time if time < SOON => block.saturating_mul(2),
                time if time > SOON * 2 => (block / 2).max(1),
                _ => block,
            };
            progress(made);
            if made < steps && self.hook.stops() {
                self.hook.take();
                return Err(RunError::Interrupted);
            }
        }
        Ok(())
    }

    /// Advances all members to the time `t`, which is a whole number of steps from the current time.
    ///
    /// # Errors
    /// [`RunError::Interrupted`] and those of [`Ensemble::advance_to`].
    pub fn advance_to(&mut self, t: f64) -> Result<(), RunError> {
        let steps = self.members.steps_to(t)?;
        self.advance(steps)
    }

    /// The number of members.
    #[must_use]
    #[allow(clippy::len_without_is_empty)] // It has at least one member.
    pub fn len(&self) -> usize {
        self.of[0]
    }

    /// The number of coordinates of a member, which is that of its momenta.
    #[must_use]
    pub fn degrees_of_freedom(&self) -> usize {
        self.of[1]
    }

    /// The number of steps made.
    #[must_use]
    pub fn steps(&self) -> u64 {
        self.members.steps()
    }

    /// The step size.
    #[must_use]
    pub fn step(&self) -> f64 {
        self.step
    }

    /// The time of the members that have not failed.
    #[must_use]
    pub fn t(&self) -> f64 {
        self.clock.at(self.steps())
    }

    /// The current states.
    #[must_use]
    pub fn states(&self) -> MemberStates {
        MemberStates::of(&mut self.members.states(), self.of)
    }

    /// Advances all members by the whole steps up to `t`, any later time, and returns their states at `t`.
    ///
    /// # Errors
    /// [`RunError::Interrupted`] and those of [`Ensemble::advance_until`].
    pub fn advance_until(&mut self, t: f64) -> Result<MemberStates, RunError> {
        /// The largest number of steps that is exact.
        const MOST: f64 = (1_u64 << 53) as f64;
        // The blocks before the last step; what remains is one call.
        let left = ((t - self.t()) / self.clock.interval).floor();
        if (2.0..MOST).contains(&left) {
            self.advance(left as u64 - 1)?;
        }
        Ok(MemberStates::of(
            &mut self.members.advance_until(t)?,
            self.of,
        ))
    }
}

impl Debug for Swarm {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.debug_struct("Swarm")
            .field("members", &self.members)
            .finish_non_exhaustive()
    }
}

/// The starts of members, those of a member together, and their systems: one, or one for each.
#[derive(Clone, Copy)]
pub(crate) struct Starts<'a> {
    pub(crate) systems: &'a [RuntimeSystem],
    pub(crate) q: &'a [f64],
    pub(crate) p: &'a [f64],
    pub(crate) t: f64,
}

impl Starts<'_> {
    /// The number of members, for which all lists have their numbers.
    pub(crate) fn count(&self) -> Result<usize, RunError> {
        let none = RunError::Length {
            what: "systems",
            expected: 1,
            found: 0,
        };
        let width = self.systems.first().ok_or(none)?.degrees_of_freedom();
        let count = match self.systems.len() {
            1 => self.q.len() / width.max(1),
            count => count,
        };
        let expected = count * width;
        for (what, found) in [("coordinates", self.q.len()), ("momenta", self.p.len())] {
            if found != expected {
                return Err(RunError::Length {
                    what,
                    expected,
                    found,
                });
            }
        }
        Ok(count)
    }

    /// The system and the start of a member.
    pub(crate) fn member(&self, index: usize) -> (RuntimeSystem, FlatState) {
        let system = self.systems.get(index).unwrap_or(&self.systems[0]);
        let width = system.degrees_of_freedom();
        let range = index * width..(index + 1) * width;
        let [q, p] = [self.q, self.p].map(|all| all[range.clone()].to_vec());
        (system.clone(), State::new(q, p).at(self.t))
    }
}

impl MemberStates {
    /// The states of `count` members of `width` coordinates.
    fn of(
        states: &mut dyn Iterator<Item = Result<FlatState, Error>>,
        [count, width]: [usize; 2],
    ) -> MemberStates {
        let mut all = MemberStates {
            t: Vec::with_capacity(count),
            q: Vec::with_capacity(count * width),
            p: Vec::with_capacity(count * width),
            errors: Vec::new(),
        };
        for (index, state) in states.enumerate() {
            match state {
                Ok(state) => {
                    all.t.push(state.t);
                    all.q.extend(state.q.iter());
                    all.p.extend(state.p.iter());
                }
                Err(error) => {
                    all.t.push(f64::NAN);
                    all.q.extend(std::iter::repeat_n(f64::NAN, width));
                    all.p.extend(std::iter::repeat_n(f64::NAN, width));
                    let error = match error {
                        Error::Sweep(SweepError::Member { error, .. }) => *error,
                        other => other,
                    };
                    all.errors.push((index, error));
                }
            }
        }
        all
    }
}
