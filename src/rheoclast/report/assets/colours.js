// Colours as red, green, blue from 0 to 1, and scales of them.

const SEQUENCE = ["#0d0887", "#7e03a8", "#cc4778", "#f89540"]; // of failures, first to last: "plasma" without its palest end
const PALE = rgb("#e3e3e3"); // of a contact without load, or that does not fail

function rgb(hexadecimal) {
  return [1, 3, 5].map((at) => parseInt(hexadecimal.slice(at, at + 2), 16) / 255);
}

// Colour at a share from 0 to 1 of a row of colours.
function between(colours, share) {
  const place = Math.min(1, Math.max(0, share)) * (colours.length - 1);
  const k = Math.min(Math.floor(place), colours.length - 2);
  return mixed(colours[k], colours[k + 1], place - k);
}

function mixed(first, second, share) {
  return first.map((value, k) => value + share * (second[k] - value));
}

// A scale of a load: from −limit to limit where it has a sign, else from 0.
function loadScale(load, palettes) {
  const names = palettes[load.signed ? "signed" : "unsigned"];
  const colours = names.map(rgb);
  const low = load.signed ? -load.limit : 0;
  return {
    low,
    high: load.limit,
    gradient: `linear-gradient(to right, ${names.join(", ")})`,
    colour: (value) => between(colours, (value - low) / (load.limit - low)),
  };
}

function theme() {
  const style = getComputedStyle(document.documentElement);
  const named = (name) => rgb(style.getPropertyValue(name).trim());
  return { paper: named("--paper"), sphere: named("--sphere"), failed: named("--failed") };
}
