// What the module of the browser asks of its host: a way out of work that is to stop, since nothing unwinds there, and the clock.

const LEFT = Symbol("left");

/** Does something; whether it was left. */
export function attempt(what) {
  try {
    what();
    return false;
  } catch (problem) {
    if (problem === LEFT) return true;
    throw problem;
  }
}

/** Goes back to the innermost attempt. */
export function leave() {
  throw LEFT;
}

/** Seconds since some moment. */
export function seconds() {
  return performance.now() / 1000;
}

/** Keeps the words of a panic for whoever sees the trap that follows. */
export function panicked(words) {
  globalThis.chetaevPanic = words;
}
