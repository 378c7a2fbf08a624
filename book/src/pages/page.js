// What the pages share: the module, a canvas in device pixels, the loop of frames.

/** Loads a module; its functions are those that the crate exports. */
export async function load(name) {
  const { instance } = await WebAssembly.instantiateStreaming(fetch(`${name}.wasm`));
  return instance.exports;
}

/** Gives the canvas as many pixels as it covers on the screen, and returns its context, scaled to a square of side 2 about 0. */
export function square(canvas) {
  const side = Math.round(canvas.clientWidth * (window.devicePixelRatio || 1));
  if (canvas.width !== side) canvas.width = canvas.height = side;
  const context = canvas.getContext("2d");
  context.setTransform(side / 2, 0, 0, -side / 2, side / 2, side / 2);
  return context;
}

/** With `?still=N` the page makes N frames of a sixtieth of a second and stops: a picture that tests compare. */
const still = Number(new URLSearchParams(location.search).get("still"));

/** The moment at which the work of a frame stops that may take so many milliseconds. */
export function until(milliseconds) {
  return still ? Infinity : performance.now() + milliseconds;
}

/** Calls `draw` with the seconds since the last frame, each frame; `window.page` counts frames for the tests. */
export function frames(draw) {
  window.page = { frames: 0, since: performance.now() };
  if (still) {
    for (; window.page.frames < still; window.page.frames += 1) draw(1 / 60);
    return;
  }
  let before = performance.now();
  const next = (now) => {
    draw(Math.min((now - before) / 1000, 0.1));
    before = now;
    window.page.frames += 1;
    requestAnimationFrame(next);
  };
  requestAnimationFrame(next);
}

/** Shows a small number with two digits. */
export function small(number) {
  return number === 0 ? "0" : number.toExponential(1);
}

/** The number of a slider, which is shown beside it; `change` is called when it moves. */
export function slider(id, change) {
  const input = document.getElementById(id);
  const shown = input.parentElement.querySelector("output");
  const digits = Number(input.step) < 0.01 ? 3 : 2;
  const show = () => { shown.value = Number(input.value).toFixed(digits); };
  input.addEventListener("input", () => { show(); change(); });
  show();
  return () => Number(input.value);
}
