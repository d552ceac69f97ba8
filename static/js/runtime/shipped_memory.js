/**
 * The memory of an interpreter that the book comes with: at a first visit Python begins with it, and
 * with what most scenes share imported. It was made when the book was built, and is a module of
 * WebAssembly, whose data is what the start of Python changes in a memory, and which writes that as
 * it is instantiated.
 */

/** @import { Memory } from "./memory.js" */
/** @import { Parts } from "./parts.js" */

export const SHIPPED = "memory.wasm";
/** The section of the module with what is told of the memory, as JSON. */
const ABOUT = "about";

/**
 * @param {Parts} parts
 * @returns {Memory | null} Nothing where the book comes with none.
 */
export function shippedMemory(parts) {
  if (!(SHIPPED in parts.table.integrity)) return null;
  const code = compiled(parts);
  code.catch(() => {}); // told to who goes on with it
  return {
    async goOn(module) {
      const written = await code;
      const [section] = WebAssembly.Module.customSections(written, ABOUT);
      const { size, references, ...about } = JSON.parse(new TextDecoder().decode(section));
      if (module.HEAP8.length < size) module.growMemory(size);
      module.API.restoreSnapshot = () => {
        new WebAssembly.Instance(written, { python: { memory: module.memory } });
        return references;
      };
      return about;
    },
  };
}

/**
 * Where it cannot be had, whatever the reason, Python starts without it: none of the faults that
 * readers are told of.
 *
 * @param {Parts} parts
 */
async function compiled(parts) {
  const reply = await parts.reply(SHIPPED).catch((fault) => {
    throw new Error(`starting without the memory: ${fault.message}`);
  });
  return WebAssembly.compile(await reply.arrayBuffer());
}
