// Within the script of the report: what the page around it asks of the report that is shown.

const toggle = () => find("#animation .play")?.click();
const isPlaying = () => find("#animation .play")?.getAttribute("aria-label") === words.pause;

globalThis.shown = {
  /** Where the reader is. */
  state() {
    return {
      scroll: scrollY,
      time: clock.time,
      playing: isPlaying(),
      open: findAll("details[open][id], details[open] > summary [id]").map((element) => element.closest("details").id || element.id),
    };
  },

  /** Goes there again. */
  resume(state) {
    for (const id of state.open) {
      const found = byId(id)?.closest("details");
      if (found) openUp(found);
    }
    scrollTo(0, state.scroll);
    const [first, last] = [data.trajectory?.times[0], data.trajectory?.times.at(-1)];
    if (state.time >= first && state.time <= last) clock.set(state.time);
    if (state.playing !== isPlaying()) toggle();
  },

  /** Another motion of the same model, at the same moment. */
  move(other, next) {
    const [time, playing] = [clock.time, isPlaying()];
    if (playing) toggle();
    clock.listeners.length = 0;
    themed.length = 0;
    Object.assign(data, { trajectory: next.trajectory, plots: next.plots, animation: next.animation, strides: next.strides });
    for (const id of ["animation", "motion"]) {
      const [old, fresh] = [document.getElementById(id), other.getElementById(id)];
      if (old && fresh) old.replaceWith(document.adoptNode(fresh));
    }
    setUpPlots();
    setUpAnimation();
    const last = data.trajectory?.times.at(-1);
    if (Number.isFinite(time)) clock.set(Math.min(time, last ?? time));
    if (playing !== isPlaying()) toggle();
  },
};
