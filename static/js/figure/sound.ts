/** Plays the sound of a figure, until its samples end or its button is pressed again. */

import type { LiveFigure, Sound } from "./live.ts";

/** How long a sound fades in and out, in seconds: a sudden step would click. */
const FADE_S = 0.012;

let context: AudioContext | null = null;

class Player {
  #sound: Sound | null = null;
  #node: AudioBufferSourceNode | null = null;
  #gain: GainNode | null = null;
  #begun = 0;

  constructor(readonly ended: () => void) {}

  get isPlaying() {
    return this.#node !== null;
  }

  /** Play from the beginning or, in place of a sound that plays, from the place that it has reached. */
  play(sound: Sound) {
    if (this.#sound && isSame(sound, this.#sound)) return;
    context ??= new AudioContext();
    const at = this.isPlaying ? context.currentTime - this.#begun : 0;
    this.stop();
    const { rate, samples } = sound;
    const buffer = context.createBuffer(1, samples.length, rate);
    buffer.copyToChannel(samples, 0);
    const [node, gain] = [new AudioBufferSourceNode(context, { buffer }), new GainNode(context)];
    gain.gain.setValueAtTime(0, context.currentTime);
    gain.gain.linearRampToValueAtTime(1, context.currentTime + FADE_S);
    node.connect(gain).connect(context.destination);
    node.onended = () => {
      if (node === this.#node) this.#end();
    };
    [this.#sound, this.#node, this.#gain] = [sound, node, gain];
    this.#begun = context.currentTime - at;
    node.start(0, at);
  }

  stop() {
    if (!context) return;
    const now = context.currentTime;
    this.#gain?.gain.cancelScheduledValues(now).setTargetAtTime(0, now, FADE_S / 3);
    this.#node?.stop(now + 2 * FADE_S);
    [this.#sound, this.#node, this.#gain] = [null, null, null];
  }

  #end() {
    this.stop();
    this.ended();
  }
}

const players: WeakMap<HTMLElement, Player> = new WeakMap();

/** Play the sound of a figure, also of later frames, or stop it. */
export async function toggleSound(figure: HTMLElement, button: HTMLButtonElement) {
  const { live } = figure as HTMLElement & { live: LiveFigure | null };
  if (!live) return;
  const player = players.get(figure) ?? newPlayer(figure, live, button);
  if (player.isPlaying) player.stop();
  else {
    const sound = await live.sound();
    if (sound) player.play(sound);
  }
  show(button, player.isPlaying);
}

function newPlayer(figure: HTMLElement, live: LiveFigure, button: HTMLButtonElement) {
  const player = new Player(() => show(button, false));
  players.set(figure, player);
  figure.addEventListener("painted", async () => {
    const sound = player.isPlaying ? await live.sound() : null;
    if (sound && player.isPlaying) player.play(sound);
  });
  figure.addEventListener("figure-leave", () => player.stop());
  return player;
}

function show(button: HTMLButtonElement, isPlaying: boolean) {
  const { play = "", stop = "" } = button.dataset;
  button.textContent = isPlaying ? stop : play;
}

function isSame(one: Sound, other: Sound) {
  return (
    one.rate === other.rate &&
    one.samples.length === other.samples.length &&
    one.samples.every((value, index) => value === other.samples[index])
  );
}
