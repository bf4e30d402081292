// node print.mjs MODULE FUNCTION: what the module prints.
import { readFileSync } from 'node:fs';

const [file, name] = process.argv.slice(2);
const printed = [];
const print = (at, length) => printed.push(Buffer.from(exports.memory.buffer.slice(at, at + length)));
const { exports } = (await WebAssembly.instantiate(readFileSync(file), { host: { print } })).instance;
exports[name]();
process.stdout.write(Buffer.concat(printed));
